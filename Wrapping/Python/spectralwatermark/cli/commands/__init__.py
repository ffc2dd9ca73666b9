# SPDX-License-Identifier: BSD-3-Clause
"""What each command does to one mesh: a request in, a result out, both of plain values."""

from __future__ import annotations

import csv
import re
import time
from collections.abc import Callable
from pathlib import Path

from spectralwatermark import (
    vtkManifoldHarmonics,
    vtkMeshAttack,
    vtkMeshDistortion,
    vtkSpectralWatermarkAlgorithm,
    vtkSpectralWatermarkDetect,
    vtkSpectralWatermarkEmbed,
)
from spectralwatermark.io import (
    MeshFileError,
    check_writable,
    read_mesh,
    stores_float,
    write_file,
    write_mesh,
)
from spectralwatermark.execution import FilterError, update
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkCommand, vtkSMPTools
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkTable
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

from .. import terminal

Show = Callable[[float, str], None]


def run(request: dict, show: Show) -> dict:
    """The result; an "error" in it, in one line, when something went wrong."""
    if request.get("skip"):
        return {"file": request["input"], "output": request["output"], "skipped": True}
    vtkSMPTools.Initialize(request["threads"])
    try:
        if "output" in request:
            check_writable(request["output"])
            if request["command"] in ("embed", "attack"):
                stores_float(request["output"])  # raises for a format that cannot be written
        return {"file": request["input"]} | _COMMANDS[request["command"]](request, show)
    except MeshFileError as error:  # names its file
        return {"file": request["input"], "error": str(error)}
    except FilterError as error:
        files = " and ".join(request[name] for name in ("input", "other", "marked") if name in request)
        return {"file": request["input"], "error": f"{files}: {_in_options(str(error))}"}
    except ModuleNotFoundError as error:  # names the package to install
        return {"file": request["input"], "error": str(error)}
    except Exception as error:  # noqa: BLE001 - one file must not end the run, nor look like "not found"
        return {"file": request["input"],
                "error": f"{request['input']}: {type(error).__name__}: {error}; please report this"}


# What the filters call it, as a regular expression, and what it is called here.
_OPTIONS = {
    "the scheme PaperSlots": "--scheme paper", "MaximumDistortion": "--distortion",
    r"Set FirstComponent to \d+ or more, or take": "Take", "set OutputPointsPrecision to double, or ": "",
    r"\bScaleFactor": "--scale", "AxisScaleFactors": "--stretch", "NoisePercent": "--noise",
    "NoiseFactor": "--noise-along-normals", "SmoothingIterations": "--smooth", "NumberOfHarmonics": "--low-pass",
    "QuantizationBits": "--quantize", "SimplificationPercent": "--simplify",
    "lower NumberOfSubdivisions": "subdivide it less often", "RemeshingPercent": "--remesh",
    "IsosurfaceResolution": "--isosurface", "CroppingPercent": "--crop",
    r" \(vtkFillHolesFilter\), or use the uniform remeshing": ", or use --remesh",
}


def _in_options(text: str) -> str:
    for name, option in _OPTIONS.items():
        text = re.sub(name, option, text)
    return text


def _update(algorithm: vtkAlgorithm, show: Show, what: str) -> float:
    """Seconds taken."""
    started = time.monotonic()
    update(algorithm, lambda share: show(share, what), terminal.stopped)
    return time.monotonic() - started


def _read_sound(path: str) -> vtkPolyData:
    """A mesh that filters take: what every one of them refuses is said here, with its file's name."""
    mesh = read_mesh(path)
    quick = vtkMeshAttack()
    quick.SetInputData(mesh)
    try:
        update(quick)
    except FilterError as error:
        raise MeshFileError(f"{path}: {error}") from None
    return mesh


# --- Watermarks ----------------------------------------------------------------------------------


def _embed(request: dict, show: Show) -> dict:
    mesh = read_mesh(request["input"])
    embed = vtkSpectralWatermarkEmbed()
    _set_watermark(embed, request)
    embed.SetInputData(mesh)
    if request["message"] or _has_secret(request):
        embed.SetMessage(request["message"])
    embed.SetMaximumDistortion(request["distortion"])
    if stores_float(request["output"]):  # have the mark verified on what the file will hold
        embed.SetOutputPointsPrecision(vtkAlgorithm.SINGLE_PRECISION)
    seconds = _update(embed, show, "embedding")
    if not embed.GetConverged():
        raise FilterError("the mark could not be embedded so that it is read back; nothing was written. "
                          "Try fewer bits or more --distortion")
    marked = embed.GetOutput()
    marked.GetPointData().RemoveArray("GeometricDistortion")  # would tell everyone that there is a mark, and where
    write_mesh(marked, request["output"], request["force"])
    result = {"output": request["output"], "scheme": request["scheme"], "secret": _has_secret(request),
              "bits": len(embed.GetExtractedMessage()), "seconds": round(seconds, 3)}
    if request["scheme"] == "robust":
        result |= {"distortion_percent": embed.GetDistortion(), "margin": embed.GetMargin()}
    else:
        result["iterations"] = embed.GetNumberOfIterationsUsed()
    return result


def _detect(request: dict, show: Show) -> dict:
    warnings: list[str] = []
    detect = _detector(request, warnings)
    detect.SetInputData(read_mesh(request["input"]))
    seconds = _update(detect, show, "detecting")
    derived = bool(detect.GetUseDerivedMessage())
    expected = derived or bool(request["message"])
    valid = bool(detect.GetMessageIsValid())
    read = detect.GetExtractedMessage()
    result = {"scheme": request["scheme"], "secret": _has_secret(request), "bits": len(read),
              "read": read, "valid": valid, "seconds": round(seconds, 3)}
    if expected:
        _check_provable(detect, warnings)
        result |= {"found": bool(detect.GetDetected()), "p_value": detect.GetPValue(),
                   "wrong_bits": _wrong_bits(detect)}
    elif request["scheme"] == "robust":  # messages of the paper's scheme have no check: read, not found
        result["found"] = valid
    if not derived and valid and (text := _text_of(read)):
        result["text"] = text
    return result


def _detector(request: dict, warnings: list[str]) -> vtkSpectralWatermarkDetect:
    """What it warns of is appended to the list."""
    detect = vtkSpectralWatermarkDetect()
    _set_watermark(detect, request)
    detect.SetExpectedMessage(request["message"])
    detect.SetUseDerivedMessage(
        _has_secret(request) and not request["message"] and not request["read"])
    detect.SetFalsePositiveRate(request["rate"])

    def warn(_caller, _event, text: str) -> None:
        warnings.append(text)

    warn.CallDataType = "string0"
    detect.AddObserver(vtkCommand.WarningEvent, warn)
    return detect


def _check_provable(detect: vtkSpectralWatermarkDetect, warnings: list[str]) -> None:
    """Where even full agreement would not count as found, "not found" would say nothing."""
    if any("cannot prove" in text for text in warnings):
        raise FilterError(f"{len(detect.GetExtractedMessage())} bits cannot prove a mark at a false positive rate of "
                          f"{detect.GetFalsePositiveRate():g}: look for more bits, or give --false-positive-rate "
                          f"(here p = {detect.GetPValue():.2g}, {_wrong_bits(detect)} bits wrong)")


def _wrong_bits(detect: vtkSpectralWatermarkDetect) -> int:
    return round(detect.GetBitErrorRate() * len(detect.GetExtractedMessage()))


def _set_watermark(watermark: vtkSpectralWatermarkAlgorithm, request: dict) -> None:
    if request["scheme"] == "paper":
        watermark.SetSchemeToPaperSlots()
    watermark.SetNumberOfBits(request["bits"])
    if "key_file" in request:
        watermark.SetSecretKeyFile(request["key_file"])
    if "key" in request:
        watermark.SetSecretKey(request["key"])


def _has_secret(request: dict) -> bool:
    return "key" in request or "key_file" in request


def _text_of(bits: str) -> str:
    """The text that the bits spell, "" when they spell none."""
    if len(bits) % 8:
        return ""
    try:
        text = bytes(int(bits[i:i + 8], 2) for i in range(0, len(bits), 8)).decode()
    except UnicodeDecodeError:
        return ""
    return text if text.isprintable() else ""


# --- Attacks -------------------------------------------------------------------------------------


def _attack(request: dict, show: Show) -> dict:
    mesh = read_mesh(request["input"])
    before = mesh.GetNumberOfPoints()
    for number, (name, value) in enumerate(request["steps"]):
        attack = vtkMeshAttack()
        attack.SetInputData(mesh)
        attack.SetSeed(request["seed"] + number)
        _ATTACKS[name](attack, value)
        _update(attack, show, name)
        mesh = attack.GetOutput()
    write_mesh(mesh, request["output"], request["force"])
    return {"output": request["output"], "steps": [name for name, _ in request["steps"]],
            "points_before": before, "points": mesh.GetNumberOfPoints()}


def _setter(kind: str, name: str = "", **more: int) -> Callable[[vtkMeshAttack, object], None]:
    def set_up(attack: vtkMeshAttack, value: object) -> None:
        attack.SetAttack(getattr(vtkMeshAttack, kind))
        for each, fixed in more.items():
            getattr(attack, f"Set{each}")(fixed)
        if name:
            _set_in_range(attack, name, value)

    return set_up


def _set_in_range(attack: vtkMeshAttack, name: str, value) -> None:
    """VTK takes what is out of range for the nearest that is in it; a user should know."""
    getattr(attack, f"Set{name}")(value)
    taken = getattr(attack, f"Get{name}")()
    if taken != (tuple(value) if isinstance(value, list) else value):
        raise FilterError(f"{name} cannot be {value}; the nearest is {taken}")


def _subdivide(attack: vtkMeshAttack, scheme: str) -> None:
    attack.SetAttackToSubdivision()
    attack.SetSubdivisionType({"midpoint": vtkMeshAttack.Midpoint, "loop": vtkMeshAttack.Loop,
                               "sqrt3": vtkMeshAttack.Sqrt3}[scheme])


_ATTACKS = {
    "similarity": _setter("Similarity"),
    "rotate": _setter("Rotation", "RotationAngle"),
    "scale": _setter("UniformScaling", "ScaleFactor"),
    "translate": _setter("Translation", "TranslationVector"),
    "stretch": _setter("NonUniformScaling", "AxisScaleFactors"),
    "noise": _setter("NoiseUniform", "NoisePercent"),
    "noise-along-normals": _setter("NoiseAlongNormals", "NoiseFactor"),
    "smooth": _setter("LaplacianSmoothing", "SmoothingIterations"),
    "low-pass": _setter("SpectralSmoothing", "NumberOfHarmonics", SmoothingGain=1),
    "quantize": _setter("Quantization", "QuantizationBits"),
    "simplify": _setter("Simplification", "SimplificationPercent"),
    "subdivide": _subdivide,
    "remesh": _setter("Remeshing", "RemeshingPercent", RemeshingMethod=vtkMeshAttack.Uniform),
    "isosurface": _setter("Remeshing", "IsosurfaceResolution",
                          RemeshingMethod=vtkMeshAttack.Isosurface),
    "crop": _setter("Cropping", "CroppingPercent"),
    "shuffle": _setter("VertexReordering"),
}


# --- Looking at meshes ---------------------------------------------------------------------------


def _compare(request: dict, show: Show) -> dict:
    reference, other = map(_read_sound, (request["input"], request["other"]))
    distortion = vtkMeshDistortion()
    distortion.SetInputData(0, reference)
    distortion.SetInputData(1, other)
    _update(distortion, show, "comparing")
    if "output" in request:
        write_mesh(distortion.GetOutput(), request["output"], request["force"])
    result = {"other": request["other"], "mrms_percent": 100.0 * distortion.GetMRMS(),
              "hausdorff_percent": 100.0 * distortion.GetHausdorff(), "msdm2": distortion.GetMSDM2()}
    if distortion.GetGeomDiff() >= 0.0:  # points correspond
        result |= {"msdm": distortion.GetMSDM(),
                   "geometric_difference_percent": 100.0 * distortion.GetGeomDiff(),
                   "curvature_difference_percent": 100.0 * distortion.GetCurvDiff()}
    return result


def _harmonics(request: dict, show: Show) -> dict:
    harmonics = vtkManifoldHarmonics()
    harmonics.SetInputData(read_mesh(request["input"]))
    harmonics.SetNumberOfHarmonics(request["number"])
    seconds = _update(harmonics, show, f"{request['number']} harmonics")
    mesh = harmonics.GetOutput()
    output = Path(request["output"])
    if output.suffix.lower() == ".csv":
        write_file(output, lambda path: _write_table(harmonics.GetOutputDataObject(1), path),
                   request["force"])
    else:
        write_mesh(mesh, output, request["force"])
    values = mesh.GetFieldData().GetArray("Eigenvalues")
    return {"output": request["output"], "number": values.GetNumberOfTuples(),
            "largest_eigenvalue": values.GetValue(values.GetNumberOfTuples() - 1),
            "seconds": round(seconds, 3)}


def _write_table(table: vtkTable, path: Path) -> None:
    columns = [table.GetColumn(i) for i in range(table.GetNumberOfColumns())]
    with path.open("w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow([column.GetName().lower() for column in columns])
        rows.writerows([[int(row[0]), *row[1:]] for row in zip(*map(vtk_to_numpy, columns))])


def _info(request: dict, show: Show) -> dict:
    from ..mesh_info import capacity_of, describe

    mesh = _read_sound(request["input"])
    result = describe(mesh)
    if request["capacity"]:
        result |= {"capacity_bits": capacity_of(mesh, request["distortion"],
                                                lambda each: _update(each, show, "measuring")),
                   "at_distortion_percent": request["distortion"]}
    return result


def _report(request: dict, show: Show) -> dict:
    from spectralwatermark.report import write_report

    warnings: list[str] = []

    def run_filter(algorithm: vtkAlgorithm, what: str) -> None:
        _update(algorithm, show, what)
        if isinstance(algorithm, vtkSpectralWatermarkDetect):
            _check_provable(algorithm, warnings)

    readings = write_report(
        _read_sound(request["input"]), _read_sound(request["marked"]), request["output"],
        lambda: _detector(request, warnings), request["title"], run_filter, request["force"])
    return {"marked": request["marked"], "output": request["output"], "found": readings[0].found,
            "attacks": len(readings) - 2, "survived": sum(each.found for each in readings[1:-1])}


_COMMANDS = {"embed": _embed, "detect": _detect, "attack": _attack, "compare": _compare,
             "harmonics": _harmonics, "info": _info, "report": _report}
