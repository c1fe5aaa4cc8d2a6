# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""What happens to a command. A disturbance is drawn by a random generator and says what may come of it."""
import dataclasses
import os
import re
import signal

from place import PRELOAD, SOURCE

ENDING = (signal.SIGTERM, signal.SIGINT, signal.SIGHUP)
KILLING = (signal.SIGKILL, signal.SIGSEGV, signal.SIGABRT)


@dataclasses.dataclass
class Disturbance:
    kind: str
    what: str                                           # in one line
    env: dict = dataclasses.field(default_factory=dict)
    prefix: list = dataclasses.field(default_factory=list)     # words before the program
    signals: list = dataclasses.field(default_factory=list)    # (share of the undisturbed time, "parent" or "worker", signal)
    disks: dict = dataclasses.field(default_factory=dict)      # folder -> bytes of a disk there, 0: read-only
    fills: list = dataclasses.field(default_factory=list)      # (share, folder): its disk is full from then on
    charges: int = 0                  # how many cases may have another status; -1: any number
    may_stop: bool = False            # or end without its results, with a sentence
    may_interrupt: bool = False       # or as by a signal (130)
    may_escape: bool = False          # a driver's process that left group and session may be left over
    draws_otherwise: bool = False     # the driver may draw something else


def to_workers(random):
    count = random.randint(1, 4)
    chosen = [random.choice((*KILLING, *ENDING, signal.SIGSTOP)) for _ in range(count)]
    names = " ".join(one.name[3:] for one in chosen)
    return Disturbance("signals to workers", names, signals=[(random.uniform(0, 1), "worker", one) for one in chosen], charges=count)


def to_parent(random):
    if random.random() < 0.2:
        pause = random.uniform(0.1, 6)
        return Disturbance("signals to the parent", f"STOP for {pause:.1f}", charges=0,
                           signals=[(random.uniform(0, 1), "parent", signal.SIGSTOP), (pause, "continue", signal.SIGCONT)])
    chosen = [random.choice((*KILLING, *ENDING)) for _ in range(random.choice((1, 1, 2, 3)))]
    return Disturbance("signals to the parent", " ".join(one.name[3:] for one in chosen), may_interrupt=True,
                       may_stop=True,
                       signals=[(random.uniform(0, 1.1), "parent", one) for one in chosen])


def to_both(random):
    one, other = to_parent(random), to_workers(random)
    return dataclasses.replace(one, kind="signals to both", what=f"{one.what} to the parent, {other.what} to workers",
                               signals=one.signals + other.signals, charges=other.charges)


LIMITS = {
    "nofile": lambda random: random.randint(3, 40),
    "as": lambda random: random.choice((1, 2, 4, 8, 16, 24)) * random.randint(50, 200) * 2**20,
    "fsize": lambda random: int(2**random.uniform(0, 22)),
    "stack": lambda random: int(2**random.uniform(17, 23)),
    "nproc": lambda random: random.randint(1, 14),
}


def of_limits(random, name=None):
    name = name or random.choice(sorted(set(LIMITS) - ({"nproc"} if os.geteuid() != 0 else set())))
    most = LIMITS[name](random)
    prefix = ["prlimit", f"--{name}={most}:{most}"]
    if name == "nproc":  # which counts a user's processes, and not root's
        user = str(random.randint(30000, 60000))
        prefix = ["setpriv", f"--reuid={user}", f"--regid={user}", "--clear-groups", *prefix]
    return Disturbance("limits", f"{name} {most}", prefix=prefix, charges=-1, may_stop=True)


def of_disks(random):
    folders = random.choice((["out"], ["out"], ["tmp"], ["out", "tmp"]))
    how = random.choice(("small", "small", "fills", "read-only"))
    size = int(2**random.uniform(12, 21))
    on = Disturbance("disks", f"{how} {' '.join(folders)}" + (f" {size}" if how == "small" else ""), may_stop=True,
                     disks=dict.fromkeys(folders, {"small": size, "fills": 64 * 2**20, "read-only": 0}[how]))
    if how == "fills":
        at = random.uniform(0, 1)
        on.fills = [(at, name) for name in folders]
    return on


def of_the_clock(random):
    return Disturbance("clock", "jumps", env={"LD_PRELOAD": PRELOAD, "EDGECASE_CHAOS_CLOCK": str(random.getrandbits(63))})


def of_frames(random, how=None):
    how = how or random.choice(("twice", "hello-twice", "short", "bit", "cut"))
    frame = random.randint(1, 12)
    starts = random.randint(1, 6)
    return Disturbance("frames", f"{how} {frame} of {starts} workers", charges=0 if how == "short" else -1, may_stop=how != "short",
                       env={"LD_PRELOAD": PRELOAD, "EDGECASE_CHAOS_FRAMES": how, "EDGECASE_CHAOS_FRAME": str(frame),
                            "EDGECASE_CHAOS_STARTS": str(starts)})


def behaviours():
    """The names of the layer's table, with the command that each hides in."""
    found = []
    for file in sorted((SOURCE / "tests" / "hostile_layer").glob("*.cpp")):
        found += re.findall(r'^ *\{"([a-z0-9-]+)",\s*Point::(\w+)', file.read_text(encoding="utf-8"), re.M)
    return found


# Those that a time limit ends, some seconds each.
SLOW = re.compile("hang|spin$|stop-itself|slow|exec-sleep|join-the|leave-the|leave-a|steal|close-results|60-gib|without-end|200-mb|for-ever|return-from|exit-by-atexit")
INTERRUPTING = re.compile("(interrupt|terminate)-the-parent")
# What a driver draws of what it was not told, or in other arithmetic, is its own.
DRAWING = re.compile("submit-nothing|rounding|flush-to-zero|changing-limits|no-limits|shared-scribbled|other-(name|uuid|version)")


def of_the_layer(random, name=None):
    tables = dict(behaviours())
    name = name or random.choice(sorted(tables))
    point = tables[name]
    if random.random() < 0.3:
        point = random.choice(("instance", "properties", "device", "pipeline", "allocate", "map", "submit", "wait"))
        if name in dict(answers()):
            point = tables[name]
    call = random.choice((1, 1, 2, 3, 5, 9)) if point in ("pipeline", "allocate", "map", "submit", "wait") else 1
    env = {"EDGECASE_HOSTILE": f"{name}@{point}:{call}"}
    if SLOW.search(name) or random.random() < 0.5:
        env["EDGECASE_HOSTILE_STARTS"] = str(random.randint(1, 2))
    else:
        env |= {"EDGECASE_HOSTILE_CHANCE": str(random.choice((50, 80, 100))), "EDGECASE_HOSTILE_SEED": str(random.getrandbits(32))}
    words = " ".join([env["EDGECASE_HOSTILE"], *(value + {"STARTS": " starts", "CHANCE": "%"}[name.rpartition("_")[2]]
                                                 for name, value in env.items() if name.endswith(("STARTS", "CHANCE")))])
    return Disturbance("driver", words, env=env, charges=-1, may_stop=True, may_interrupt=bool(INTERRUPTING.search(name)),
                       may_escape=name in ("leave-an-escaped-child", "leave-the-session"), draws_otherwise=bool(DRAWING.search(name)))


def answers():
    text = (SOURCE / "tests" / "hostile_layer" / "answers.cpp").read_text(encoding="utf-8")
    return re.findall(r'^ *\{"([a-z0-9-]+)",\s*Point::(\w+)', text, re.M)


KINDS = {"workers": to_workers, "parent": to_parent, "both": to_both, "limits": of_limits, "disks": of_disks,
         "clock": of_the_clock, "frames": of_frames, "driver": of_the_layer}
