# SPDX-License-Identifier: BSD-3-Clause
"""The meshes, messages and attacks of a run, in the full and the quick form."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from . import calibration, experiments, figures
from .experiments import ATTACKS, MODES, UNATTACKED, Mode
from .models import Collection, Model, stand_in
from .store import Store, key_of
from .work import Task

SMALL = 12000  # meshes with fewer vertices are attacked in all modes
ATTACKED_MESSAGES = 4  # in each mode
ATTACKED_LARGE = ("horse", "bunny")  # larger meshes that are attacked in the paper's first mode
ATTACKED_LARGE_MESSAGES = 2
QUICK_ATTACKS = ("rotation", "scaling", "translation", "noise-0.1", "noise-0.5", "noise-0.7",
                 "simplify-50", "simplify-90", "smooth-kept", "smooth-dropped")


@dataclass(frozen=True)
class Plan:
    """One run."""

    quick: bool
    models: tuple[Model, ...]  # the smallest first
    all_models: tuple[Model, ...]  # all of the folder, from which figures choose
    pebble_only: bool
    messages: tuple[str, ...]
    attacks: tuple[str, ...]
    random_messages: int
    keys: int
    window_stride: int

    def attacks_on(self, model: Model, mode: Mode, message: str) -> tuple[str, ...]:
        """The attacks on a marked mesh, perhaps none."""
        number = self.messages.index(message)
        if model in self.robustness_models():
            return self.attacks if number < ATTACKED_MESSAGES else ()
        if self.quick or mode.division != 0:
            return ()
        if model.name in ATTACKED_LARGE and mode.embedding == 0:
            return self.attacks if number < ATTACKED_LARGE_MESSAGES else ()
        if model.name == "igea":  # the attacks of the figures that show it
            return ("simplify-50",) if mode.embedding == 0 else ("smooth-kept", "smooth-dropped")
        return ()

    def robustness_models(self) -> tuple[Model, ...]:
        """The meshes that are attacked in all modes."""
        small = tuple(model for model in self.models if model.vertices < SMALL)
        return (small or self.models[:1])[:2 if self.quick else None]


def quick_plan(meshes: Collection) -> Plan:
    """The two smallest meshes and the elephant, which is in the paper's tables."""
    elephant = [model for model in meshes.models[2:] if model.name == "elephant"]
    return Plan(True, (*meshes.models[:2], *elephant), meshes.models, meshes.pebble_only,
                tuple(experiments.messages(1 if meshes.pebble_only else 2)), QUICK_ATTACKS,
                random_messages=1000, keys=200, window_stride=4)


def full_plan(meshes: Collection) -> Plan:
    return Plan(False, meshes.models, meshes.models, meshes.pebble_only,
                tuple(experiments.messages(8)), tuple(attack.key for attack in ATTACKS),
                random_messages=1000, keys=1000, window_stride=1)


# --- Keys of the results -----------------------------------------------------------------------


def mark_key(model: Model, mode: Mode, message: str, attack: str) -> str:
    return key_of("marked", model, mode.key, message, attack)


def unmarked_key(model: Model, attack: str) -> str:
    return key_of("unmarked", model, attack)


def calibration_key(plan: Plan, model: Model) -> str:
    return key_of("calibration", model, str(plan.random_messages), str(plan.keys),
                  str(plan.window_stride))


def keys_of(plan: Plan) -> set[str]:
    """The keys of all results on the run's page except the times."""
    keys = {calibration_key(plan, model) for model in plan.models}
    keys |= {drawing.key() for drawing in drawings(plan)}
    for model in plan.robustness_models():
        keys |= {unmarked_key(model, attack) for attack in (UNATTACKED, *plan.attacks)}
    for model in plan.models:
        for mode in MODES:
            for message in plan.messages:
                keys |= {mark_key(model, mode, message, attack)
                         for attack in (UNATTACKED, *plan.attacks_on(model, mode, message))}
    return keys


def refused(plan: Plan, store: Store) -> list[tuple[str, str, str]]:
    """Attacks that a filter refused: the model, the experiment and the filter's message."""
    result = []
    for key, message in store.refused(keys_of(plan)):
        kind, name, _size, *details, _version = key.split(" ")
        result.append((name, f"{kind}, {', '.join(details)}", message))
    return result


# --- Tasks -------------------------------------------------------------------------------------


def tasks_of(plan: Plan, store: Store, folder: Path) -> list[Task]:
    """Everything that the store does not contain yet."""
    tasks = []
    for model in plan.models:
        tasks += _mark_tasks(plan, store, model)
        tasks += _calibration_tasks(plan, store, model)
    for model in plan.robustness_models():
        tasks += _unmarked_tasks(plan, store, model)
    return tasks + figure_tasks(plan, store, folder)


def _cost(model: Model) -> float:
    """The cost of one eigenproblem with the harmonics of five slots; grows faster than linearly."""
    return model.vertices * (model.vertices / 10000.0) ** 0.45


def _attack_cost(model: Model, attacks: list[str]) -> float:
    smoothing = 6.0 if any(key.startswith("smooth") for key in attacks) else 0.0
    return _cost(model) * (len(attacks) + smoothing)


def _mark_tasks(plan: Plan, store: Store, model: Model) -> list[Task]:
    tasks = []
    for mode in MODES:
        iterations = 4.0 if mode.division == 0 else 9.0
        for message in plan.messages:
            wanted = (UNATTACKED, *plan.attacks_on(model, mode, message))
            missing = [key for key in wanted
                       if mark_key(model, mode, message, key) not in store]
            if not missing:
                continue
            keys = tuple(mark_key(model, mode, message, key) for key in missing)
            tasks.append(Task(
                experiments.mark_and_attack, (model, mode.key, message, missing), keys, model,
                f"marking with {message}, {mode.title.lower()}",
                _cost(model) * iterations + _attack_cost(model, missing)))
    return tasks


def _unmarked_tasks(plan: Plan, store: Store, model: Model) -> list[Task]:
    missing = [key for key in (UNATTACKED, *plan.attacks) if unmarked_key(model, key) not in store]
    if not missing:
        return []
    return [Task(experiments.attack_unmarked, (model, missing),
                 tuple(unmarked_key(model, key) for key in missing), model,
                 "attacking without a mark", _attack_cost(model, missing))]


def _calibration_tasks(plan: Plan, store: Store, model: Model) -> list[Task]:
    key = calibration_key(plan, model)
    if key in store:
        return []
    arguments = (model, plan.random_messages, plan.keys, plan.window_stride)
    numpys_share = 60.0 * (plan.random_messages + 2.0 * plan.keys) + 2e5 / plan.window_stride
    return [Task(calibration.calibrate, arguments, (key,), model, "calibration of the detector",
                 8.0 * _cost(model) + numpys_share)]


def figure_tasks(plan: Plan, store: Store, folder: Path) -> list[Task]:
    """The paper's figures, each drawn from the mesh that stands for the paper's."""
    tasks = []
    for drawing in drawings(plan):
        key = drawing.key()
        if figures.are_drawn(folder, store.get(key)):
            continue
        arguments = (drawing.function, folder, drawing.files, drawing.arguments)
        tasks.append(Task(figures.draw, arguments, (key,), drawing.model,
                          f"figure {drawing.number}", drawing.cost * _cost(drawing.model) + 30000))
    return tasks


@dataclass(frozen=True)
class Drawing:
    """One figure, or several from one computation."""

    number: str
    papers: str  # name of the paper's model
    model: Model
    function: Callable[..., list[dict]]
    arguments: tuple
    files: tuple[str, ...]
    cost: float  # in eigenproblems

    def key(self) -> str:
        return key_of("figure", self.model, self.number,
                      *(_text_of(argument) for argument in self.arguments))


def _text_of(argument: object) -> str:
    if isinstance(argument, tuple):
        return "+".join(_text_of(part) for part in argument)
    return argument.name if isinstance(argument, Model) else str(argument)


def drawings(plan: Plan) -> list[Drawing]:
    def drawing(number: str, papers: str, function: Callable, *arguments: object,
                files: tuple[str, ...], cost: float) -> Drawing:
        model = stand_in(plan.models, papers)
        return Drawing(number, papers, model, function, (model, *arguments), files, cost)

    names = figures.NAMES
    result = [
        drawing("2", "Kitten", figures.draw_harmonics, files=(names["2"],), cost=5.0),
        drawing("3", "Iphigenia", figures.draw_doubling, names["3"], names["4"], names["5"],
                files=(names["3"], names["4"], names["5"]), cost=5.0),
        drawing("6", "Igea", figures.draw_doubling, "", names["6"], names["7"],
                files=(names["6"], names["7"]), cost=5.0),
    ]
    candidates = _evolution_candidates(plan)
    result.append(Drawing("8", "Igea", candidates[0], figures.draw_evolution, (candidates,),
                          (names["8"],), 8.0))
    for number, papers, mode in (("9", "Dinosaur", 0), ("10", "Gargoyle", 1), ("11", "Greek", 2),
                                 ("12", "Shell", 3)):
        result.append(drawing(number, papers, figures.draw_mark, MODES[mode].key, names[number],
                              files=(names[number],), cost=10.0))
    for number, papers, mode, attacks in (
            ("13", "Igea", 0, ("simplify-50",)), ("14", "Elephant", 0, ("noise-0.5",)),
            ("15", "Topology", 2, ("noise-0.7",)),
            ("16", "Igea", 1, ("smooth-dropped", "smooth-kept"))):
        result.append(drawing(number, papers, figures.draw_attack, MODES[mode].key, attacks,
                              names[number], files=(names[number],), cost=10.0))
    return result


def _evolution_candidates(plan: Plan) -> tuple[Model, ...]:
    """Where the paper's Figure 8 may be found again: Igea first, and meshes on which single
    magnitudes are known to move slowly."""
    igea = stand_in(plan.models, "Igea")
    others = [model for model in plan.all_models
              if model.name in ("camelhead", "armadillo") and model != igea]
    others.sort(key=lambda model: model.vertices)
    return (igea, *others[:1 if plan.quick else None])
