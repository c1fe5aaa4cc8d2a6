# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""One round: a command is disturbed and what it left is compared with what the undisturbed one leaves."""
import dataclasses
import os
import random
import signal
import subprocess
import time

import disturbances
from place import PROGRAM, Place, resident_bytes, status_of
from workloads import INTERRUPTED, WORKLOADS

LONGEST = 150  # seconds: a safety net, since nothing here takes a tenth of it on an idle machine
MOST_MEMORY = 2**30  # of the parent, whatever a worker announces
CODES = {0, 1, 2, 3, 4, 5, 6, 7, INTERRUPTED}
ROUNDS = ("driver", "workers", "driver", "parent", "driver", "limits", "driver", "disks", "driver", "frames", "driver", "both",
          "driver", "parent", "driver", "clock")


@dataclasses.dataclass
class End:
    code: int          # negative: the signal that the program died of
    seconds: float
    output: str
    errors: str
    sent: dict         # how many signals reached "parent" and "worker"
    stopped: str = ""  # why the round ended it


def execute(place, words, env=None, on=None, usual=1.0):
    """Runs the program under a disturbance, whose times are shares of `usual` seconds."""
    on = on or disturbances.Disturbance("none", "none")
    files = [place.root / "stdout", place.root / "stderr"]
    begin = time.monotonic()
    with open(files[0], "wb") as out, open(files[1], "wb") as err:
        child = subprocess.Popen([*on.prefix, PROGRAM, *map(str, words)], env=place.environment() | (env or {}) | on.env, cwd=place.work,
                                 stdin=subprocess.DEVNULL, stdout=out, stderr=err, start_new_session=True)
    events = sorted([(share * usual, target, what) for share, target, what in on.signals if target != "continue"] +
                    [(share * usual, "fill", name) for share, name in on.fills])
    sent = {"parent": 0, "worker": 0}
    stopped = ""
    ending_since = None
    while child.poll() is None:
        now = time.monotonic() - begin
        while events and events[0][0] <= now:
            _, target, what = events.pop(0)
            if target == "fill":
                fill(getattr(place, what))
                continue
            pids = [child.pid] if target == "parent" else workers_of(child.pid, place)
            if not pids:
                events.append((now + 0.003, target, what))  # when there is one
                events.sort()
                break
            pid = pids[int(now * 1e6) % len(pids)]
            if send(pid, what):
                sent[target] += 1
                if what == signal.SIGSTOP and target == "parent":
                    time.sleep(next(pause for pause, word, _ in on.signals if word == "continue"))
                    send(pid, signal.SIGCONT)
                elif target == "parent":
                    ending_since = ending_since or time.monotonic()
        if now > LONGEST:
            stopped = f"it had not ended after {LONGEST} s"
        elif ending_since is not None and time.monotonic() - ending_since > LONGEST / 3:
            stopped = f"it had not ended {LONGEST // 3} s after a signal that ends it"
        elif resident_bytes(child.pid) > MOST_MEMORY:
            stopped = "it took more than 1 GiB"
        if stopped:
            stopped += f" ({resident_bytes(child.pid) >> 20} MiB, {len(place.processes()) - 1} others)"
            for pid in (child.pid, *place.processes()):
                send(pid, signal.SIGKILL)
            child.wait()
            break
        time.sleep(0.002)
    return End(child.returncode, time.monotonic() - begin, *(file.read_text(errors="replace") for file in files), sent, stopped)


def send(pid, what):
    try:
        os.kill(pid, what)
        return True
    except ProcessLookupError:
        return False


def workers_of(parent, place):
    return sorted(pid for pid in place.processes() if status_of(pid)[1] == parent)


def fill(folder):
    """Takes all room that is left on a disk."""
    try:
        with open(folder / "filler", "wb", buffering=0) as file:
            while file.write(bytes(4096)) > 0:
                pass
    except OSError:
        pass


class Undisturbed:
    """What each workload leaves, found out once; twice, since what differs by itself cannot be compared."""

    def __init__(self):
        self.known = {}

    def of(self, name):
        if name not in self.known:
            work = WORKLOADS[name]
            seen = []
            for _ in range(2):
                place = Place()
                said = []
                end = execute(place, work.words(place), work.env)
                value = work.read(place, said)
                said += place.changed(False) + place.left_over()
                if said or end.stopped or value is None or end.code not in (0, 1):
                    raise SystemExit(f"chaos: error: {work.name} fails undisturbed: {said} {end}; folder {place.root}")
                seen.append((value, end))
                place.remove()
            if not work.is_equal(seen[0][0], seen[1][0]):
                work.differences(seen[0][0], seen[1][0], seen[1][1], said)
                raise SystemExit(f"chaos: error: {work.name} is not the same twice: {said[:5]}")
            self.known[name] = (seen[1][0], seen[1][1].code, seen[1][1].seconds)
        return self.known[name]


@dataclasses.dataclass
class Outcome:
    on: disturbances.Disturbance
    workload: str
    word: str            # "equal", "named", "resumed" or "not tried"
    problems: list
    seconds: float
    folder: str = ""
    exits: tuple = ()    # exit codes, the first the disturbed one's
    hits: int = 0        # signals that reached a process, or acts of a driver


def choose(seed, number):
    """The disturbance and the workload of a round."""
    chance = random.Random(f"{seed}:{number}")
    kind = ROUNDS[number % len(ROUNDS)]
    if kind == "driver":  # the whole table, one after the other
        names = sorted(name for name, _ in disturbances.behaviours())
        random.Random(str(seed)).shuffle(names)
        on = disturbances.of_the_layer(chance, names[number // 2 % len(names)])
        work = chance.choice(("suite", "suite", "suite", "hunt", "reduce"))
    else:
        on = disturbances.KINDS[kind](chance)
        work = chance.choice(("suite", "suite-reference", "hunt", "hunt-reference", "reduce"))
    return on, work


def perform(on, name, undisturbed, keeps=False):
    """Carries a round out."""
    work = WORKLOADS[name]
    base, base_code, usual = undisturbed.of(name)
    place = Place()
    begin = time.monotonic()
    said = []
    word = "not tried"
    exits = ()
    hits = 0
    if all(place.mount(folder, size or 2**20) and (size > 0 or place.protect(folder)) for folder, size in on.disks.items()):
        end = execute(place, work.words(place), work.env, on, usual)
        word, exits = judge(place, work, base, base_code, on, end, said)
        hits = sum(end.sent.values()) + place.acts()
        if word == "ended" and work.resumes:
            word, code = resume(place, work, base, on, said)
            exits = (*exits, code)
    outcome = Outcome(on, work.name, word, said, time.monotonic() - begin, str(place.root), exits, hits)
    if said and keeps:
        return outcome
    place.remove()
    return outcome


def judge(place, work, base, base_code, on, end, said):
    """What became of a disturbed command: equal, named, or ended before its end; and its exit code."""
    if end.stopped:
        said.append(end.stopped)
    is_killed = end.code < 0
    # One that ends it, and comes before it looks at signals, kills it, too.
    is_sent = any(target == "parent" and what == -end.code for _, target, what in on.signals)
    if is_killed and not is_sent and not end.stopped or not is_killed and end.code not in CODES:
        said.append(f"it ended with {end.code}: {end.errors[-200:]}")
    left = place.left_over(2 if on.may_escape else 20)
    if len(left) > (place.acts() if on.may_escape else 0):
        said += [f"left running: {line}" for line in left]
    for folder in on.disks:
        place.enlarge(folder)
        (getattr(place, folder) / "filler").unlink(missing_ok=True)
    said += place.changed(is_killed)
    if end.stopped:
        return "named", (end.code,)
    if "please report it" in end.errors:
        said.append("it calls it an internal error: " + end.errors.strip().splitlines()[-1][:200])
    now = work.read(place, [] if is_killed else said)
    count = 0 if is_killed else work.differences(base, now, end, kept := [])
    if not is_killed:
        said += [problem for problem in kept if not (on.draws_otherwise and (" instead of pass" in problem or "with other bits" in problem
                                                                              or "which is not there" in problem))]
    if 0 <= on.charges < count and end.code not in (INTERRUPTED, 7):
        said.append(f"{count} cases are not as undisturbed, after {on.charges} signals")
    if end.code in (2, 3, 4, 5, 7, INTERRUPTED) and not (end.errors + end.output).strip():
        said.append(f"it ended with {end.code} and without a word")
    is_named_disk = end.code == 2 and "out" in on.disks and "with -o" in end.errors  # whose user can choose another
    if end.code in (2, 3, 4) and not is_named_disk or end.code in (5, 7) and not on.may_stop:
        said.append(f"it ended with {end.code}: {end.errors.strip()[-200:]}")
    if end.code == INTERRUPTED and not on.may_interrupt:
        said.append("it tells of an interruption")
    is_named_death = "had no sure result" in end.errors  # of a reduction whose workers die
    if end.code in (0, 1, 6) and now is None and not on.may_stop and not is_named_death:
        said.append(f"it ended with {end.code} and without results: {end.errors.strip()[-200:]}")
    if end.code == 0 and base_code == 1 and not on.draws_otherwise:
        said.append("it ended with 0, and the undisturbed one with 1")
    if count and on.kind == "driver" and not place.acts():
        said.append("it differs, although the driver did nothing")
    if is_killed or end.code == INTERRUPTED or end.code == 7 and on.kind in ("disks", "limits"):
        return "ended", (end.code,)
    if work.is_equal(base, now) and end.code == base_code:
        return "equal", (end.code,)
    return "named", (end.code,)


def resume(place, work, base, on, said):
    """Goes on without the disturbance: the results are those of the undisturbed command."""
    end = execute(place, work.resume_words(place), work.env)
    now = work.read(place, said)
    said += [f"left running after --resume: {line}" for line in place.left_over()]
    if end.stopped:
        said.append("--resume: " + end.stopped)
    has_begun = any(entry.stat().st_size > 0 for entry in place.out.glob("*/*") if entry.name in ("journal.jsonl", "fuzz.json"))
    if end.code == 3 and end.errors.strip() and (not has_begun or on.kind in ("limits", "disks")):
        return "named", end.code  # there is nothing to go on with
    if work.is_alike(base, now):
        return "resumed", end.code
    kept = []
    count = work.differences(base, now, end, kept)
    if now is None or kept or count > on.charges >= 0 or on.kind == "disks" or end.code not in (0, 1):
        words = work.words_of(base, now) if now and hasattr(work, "words_of") else []
        said.append(f"--resume ends with {end.code} and other results: {(kept + words + [end.errors.strip()[-200:]])[:4]}")
    return "named", end.code
