# SPDX-License-Identifier: BSD-3-Clause
"""Many files: each in a process of its own, so that none can take the others down."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait

from . import code_of, terminal

_running: set[subprocess.Popen] = set()


def run_all(requests: list[dict], jobs: int, as_json: bool) -> int:
    """Results in the order of the files; the worst exit code."""
    results: list[dict] = []
    with terminal.progress(requests[0]) as show, ThreadPoolExecutor(jobs) as pool:
        futures = [pool.submit(_run_one, request) for request in requests]
        pending = set(futures)
        while pending:
            _, pending = wait(pending, timeout=0.2, return_when=FIRST_COMPLETED)
            if terminal.stopped():
                _stop(futures)
            while len(results) < len(futures) and futures[len(results)].done():
                future = futures[len(results)]
                request = requests[len(results)]
                results.append(_result_of(request, future))
                terminal.say(request, results[-1], as_json)
            done = sum(future.done() for future in futures)
            show(done / len(futures), f"{done} of {len(futures)} files")
    _summarise(requests[0]["command"], results)
    return max(code_of(result) for result in results)


def _result_of(request: dict, future: Future) -> dict:
    if future.cancelled():
        return {"file": request["input"], "error": f"{request['input']}: not done: stopped"}
    return future.result()


def _stop(futures: list[Future]) -> None:
    for future in futures:
        future.cancel()
    for process in list(_running):
        process.terminate()


def _run_one(request: dict) -> dict:
    if request.get("skip"):
        return {"file": request["input"], "output": request["output"], "skipped": True}
    # The request goes through a pipe: argument lists and environments are for others to see.
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    with subprocess.Popen([sys.executable, "-m", "spectralwatermark.command_line", "worker"],
                          stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True, env=environment, start_new_session=True) as process:
        _running.add(process)
        output, complaints = process.communicate(json.dumps(request))
        _running.discard(process)
    try:
        return json.loads(output)
    except ValueError:
        last = complaints.strip().splitlines()[-1:] or [f"the process ended with {process.returncode}"]
        return {"file": request["input"], "error": f"{request['input']}: {last[0]}"}


def work() -> int:
    """A worker: one request in, one result out."""
    import signal

    terminal.catch_signals((signal.SIGTERM,))
    request = json.load(sys.stdin)
    from .commands import run

    print(json.dumps(run(request, lambda share, what: None)))
    return 0


def _summarise(command: str, results: list[dict]) -> None:
    failed = sum("error" in result for result in results)
    counts = {"failed": failed}
    if command == "detect":
        counts = {"found": sum(bool(result.get("found")) for result in results),
                  "not found": sum(result.get("found") is False for result in results)} | counts
    elif command == "embed":
        skipped = sum(bool(result.get("skipped")) for result in results)
        counts = {"marked": len(results) - failed - skipped, "skipped": skipped} | counts
    else:
        counts = {"done": len(results) - failed} | counts
    said = ", ".join(f"{count} {name}" for name, count in counts.items() if count or name == "failed")
    print(f"{len(results)} files: {said}", file=sys.stderr, flush=True)
