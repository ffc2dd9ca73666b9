# SPDX-License-Identifier: BSD-3-Clause
"""Many files: each in a process of its own, so that none can take the others down."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from concurrent.futures import Future, ThreadPoolExecutor, wait

from . import code_of, terminal

_running: set[subprocess.Popen] = set()
_told: set[subprocess.Popen] = set()  # to stop


def run_all(requests: list[dict], jobs: int, as_json: bool) -> int:
    """Results in the order of the files; the worst exit code."""
    results: list[dict] = []
    with terminal.progress(requests[0]) as show, ThreadPoolExecutor(jobs) as pool:
        futures = [pool.submit(_run_one, request) for request in requests]
        try:
            while len(results) < len(futures):
                if terminal.stopped():
                    _stop(futures)
                if terminal.stopped_twice():
                    _kill()
                wait(futures[len(results):len(results) + 1], timeout=0.2)
                while len(results) < len(futures) and futures[len(results)].done():
                    request = requests[len(results)]
                    results.append(_result_of(request, futures[len(results)]))
                    terminal.say(request, results[-1], as_json)
                done = sum(future.done() for future in futures)
                show(done / len(futures), f"{done} of {len(futures)} files")
        except BaseException:  # nobody takes the output, say: the rest is not for nobody
            _stop(futures)
            raise
    _summarise(requests[0]["command"], results)
    return max(code_of(result) for result in results)


def _result_of(request: dict, future: Future) -> dict:
    if future.cancelled():
        return _stopped(request)
    return future.result()


def _stopped(request: dict) -> dict:
    return {"file": request["input"], "error": f"{request['input']}: not done: stopped"}


def _stop(futures: list[Future]) -> None:
    for future in futures:
        future.cancel()
    for process in _running - _told:
        process.terminate()
        _told.add(process)


def _kill() -> None:
    for process in list(_running):
        process.kill()


def _run_one(request: dict) -> dict:
    if request.get("skip"):
        return {"file": request["input"], "output": request["output"], "skipped": True}
    # The request goes through a pipe: argument lists and environments are for others to see.
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    with subprocess.Popen([sys.executable, "-m", "spectralwatermark.cli", "worker"],
                          stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          env=environment, start_new_session=True) as process:
        _running.add(process)
        output, complaints = process.communicate(json.dumps(request).encode())
        _running.discard(process)
    try:
        return json.loads(output)
    except ValueError:
        if terminal.stopped():
            return _stopped(request)
        last = complaints.decode(errors="replace").strip().splitlines()[-1:] or [
            terminal.why_it_ended(process.returncode)]
        return {"file": request["input"], "error": f"{request['input']}: {last[0]}"}


def work() -> int:
    """A worker: one request in, one result out."""
    terminal.catch_signals((signal.SIGTERM, signal.SIGHUP))
    terminal.end_with_parent()
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
