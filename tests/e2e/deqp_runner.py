# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""A double of deqp-runner's gtest-runner (gitlab.freedesktop.org/mesa/deqp-runner, 0.18), after the rules of its sources
(gtest_command.rs, parse.rs, lib.rs, runner_results.rs): what it starts, how it reads lists, result lines, crashes, time
limits and baselines, and what it draws again. It starts one process at a time."""
import re
import selectors
import subprocess
import time

GROUP = re.compile(r"(\S*\.)")
TEST = re.compile(r"\s+(\S+)")
RUN = re.compile(r"\[\sRUN\s*\]\s(.*)")
STATUS = re.compile(r"\[\s*(\S*)\s*\]\s(\S*)")
BASELINE = re.compile(r"^([^,]+),([^,]+)")
STATUSES = {"OK": "Pass", "FAILED": "Fail", "SKIPPED": "Skip"}
SUCCESS = ("Pass", "Skip", "Warn", "Flake", "KnownFlake", "ExpectedFail")
BAD = ("Fail", "Crash", "Missing", "Timeout")


class Mistake(Exception):
    """What makes the runner give up on a process: it understands a line wrongly or not at all."""


def parse_list(text):
    tests, group = [], None
    for line in text.splitlines():
        if found := GROUP.search(line):
            group = found[1]
        elif found := TEST.search(line):
            if group is None:
                raise Mistake(f"a test without a group: {line}")
            tests.append(group + found[1])
        else:
            raise Mistake(f"no list: {line}")
    return tests


def with_baseline(status, expected):
    """Of a test, by what the baseline says of it (None: nothing)."""
    if expected is None:
        return status
    if status == expected or (status, expected) in (("Fail", "ExpectedFail"),):
        return "ExpectedFail"
    return f"UnexpectedImprovement({status})" if status in ("Pass", "Skip") or (status, expected) == ("Fail", "Crash") else status


def parse_baseline(text):
    known = {}
    for line in text.splitlines():
        if line and not line.startswith("#"):
            name, status = BASELINE.match(line).groups()
            if name in known:
                raise Mistake(f"twice in the baseline: {name}")
            known[name] = status
    return known


class Runner:
    def __init__(self, program, arguments, *, env, cwd, baseline="", flakes=(), skips=(), timeout=60.0, group=500):
        self.command = [program, *arguments]
        self.options = {"env": env, "cwd": cwd, "stdin": subprocess.DEVNULL}
        self.baseline = parse_baseline(baseline)
        self.flakes = [re.compile(x) for x in flakes]
        self.skips = [re.compile(x) for x in skips]
        self.timeout, self.group = timeout, group
        self.processes = 0

    def list_tests(self):
        done = subprocess.run([*self.command, "--gtest_list_tests"], capture_output=True, text=True, check=False, **self.options)
        if done.returncode != 0:
            raise Mistake(done.stdout + done.stderr)
        return parse_list(done.stdout)

    def start(self, tests):
        """Results of one process, as it tells them."""
        self.processes += 1
        results, current = [], None
        child = subprocess.Popen([*self.command, "--gtest_filter=" + ":".join(tests)], stdout=subprocess.PIPE,
                                 stderr=subprocess.DEVNULL, text=True, **self.options)
        with child, selectors.DefaultSelector() as ready:
            ready.register(child.stdout, selectors.EVENT_READ)
            deadline, reason = time.monotonic() + self.timeout, "Crash"
            while True:
                if not ready.select(max(0, deadline - time.monotonic())):
                    reason = "Timeout"
                    child.kill()
                    break
                line = child.stdout.readline()
                if not line:
                    break
                if current is not None:
                    if found := STATUS.search(line):
                        if found[1] not in STATUSES:
                            child.kill()
                            raise Mistake(f"unknown status in: {line}")
                        results.append((current, STATUSES[found[1]]))
                        current = None
                elif found := RUN.search(line):
                    current = found[1].strip()
                    deadline = time.monotonic() + self.timeout
        if current is not None:
            results.append((current, reason))
        if len(dict(results)) != len(results):
            raise Mistake("a test has two results")
        return [(name, self.translated(name, status)) for name, status in results]

    def translated(self, name, status):
        status = with_baseline(status, self.baseline.get(name))
        return "Flake" if status not in SUCCESS and any(x.search(name) for x in self.flakes) else status

    def start_and_repeat(self, tests):
        results = self.start(sorted(tests))
        if not results:
            raise Mistake("no results")
        if any(status not in SUCCESS for _, status in results):
            again = self.start(sorted(tests))
            results = [(name, status if status == other else "Flake")
                       for (name, status), (_, other) in zip(results, again)]  # by place, as the runner does
        return results

    def run(self):
        tests = self.list_tests()
        results = {t: "Skip" for t in tests if any(x.search(t) for x in self.skips)}
        left = [t for t in tests if t not in results]
        while left:
            part = left[:self.group]
            while part:
                try:
                    new = self.start_and_repeat(part)
                except Mistake:
                    new = [(name, "Missing") for name in part]
                for name, status in new:
                    part.remove(name)
                    results[name] = status
            left = left[self.group:]
        return results


def failures_csv(results):
    """What the runner writes to failures.csv, which the next run takes as its baseline."""
    return "".join(f"{name},{status}\n" for name, status in sorted(results.items()) if status in BAD)
