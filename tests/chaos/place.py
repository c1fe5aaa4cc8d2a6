# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Where a round takes place: its folders, its processes, and what must not change around it."""
import ctypes
import hashlib
import os
import pathlib
import shutil
import signal
import tempfile
import time

SOURCE = pathlib.Path(os.environ.get("EDGECASE_SOURCE_DIR", pathlib.Path(__file__).resolve().parents[2]))
BUILD = SOURCE / "build" / "release"
PROGRAM = os.environ.get("EDGECASE_PROGRAM", str(BUILD / "bin" / "edgecase"))
LAYER = os.environ.get("EDGECASE_HOSTILE_LAYER", str(BUILD / "hostile_layer"))
PRELOAD = os.environ.get("EDGECASE_CHAOS_PRELOAD", str(BUILD / "lib" / "libchaos_preload.so"))

MS_RDONLY, MS_REMOUNT, MNT_DETACH, PR_SET_CHILD_SUBREAPER = 1, 32, 2, 36
libc = ctypes.CDLL(None, use_errno=True)
# Whose parent was killed is this process's child then, and no zombie that counts for a limit.
libc.prctl(PR_SET_CHILD_SUBREAPER, 1)


class Place:
    """Folders of one command after another: `out` takes its output, `work` is where it runs, `tmp` its TMPDIR."""

    def __init__(self):
        self.root = pathlib.Path(tempfile.mkdtemp(prefix="edgecase-chaos-"))
        self.root.chmod(0o755)
        for name in ("out", "work", "tmp", "canary", "hostile", "home"):
            setattr(self, name, self.root / name)
            (self.root / name).mkdir()
            (self.root / name).chmod(0o777)  # for another user, too
        for k in range(3):
            (self.canary / f"keep{k}.toml").write_text(f"keep {k}\n")
        self.mounted = []
        self.before = self.around()

    def environment(self):
        """The machine's without what chooses devices or options; a mark by which processes are found."""
        kept = {name: value for name, value in os.environ.items()
                if not name.startswith(("EDGECASE_", "VK_", "GITHUB_", "GITLAB_", "CI", "LD_PRELOAD"))}
        return kept | {
            "EDGECASE_SUITE": str(SOURCE / "cases" / "suite"), "EDGECASE_TEST_MARK": str(self.root), "TMPDIR": str(self.tmp),
            "HOME": str(self.home), "XDG_CACHE_HOME": str(self.home), "LP_NUM_THREADS": "2", "VK_LAYER_PATH": LAYER,
            "VK_INSTANCE_LAYERS": "VK_LAYER_EDGECASE_hostile", "EDGECASE_HOSTILE_FOLDER": str(self.hostile)}

    def processes(self):
        """Ids of the processes that carry the mark and are no zombies."""
        found = []
        for entry in pathlib.Path("/proc").iterdir():
            if entry.name.isdigit() and int(entry.name) != os.getpid():
                try:
                    if str(self.root).encode() in (entry / "environ").read_bytes() and status_of(int(entry.name))[0] != "Z":
                        found.append(int(entry.name))
                except OSError:
                    pass
        return found

    def left_over(self, patience=20.0):
        """Command lines of the processes that are still there after that many seconds; they are killed then."""
        end = time.monotonic() + patience
        reap()
        while (pids := self.processes()) and time.monotonic() < end:
            time.sleep(0.05)
        names = []
        for pid in pids:
            try:
                names.append(pathlib.Path(f"/proc/{pid}/cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace").strip())
            except OSError:
                continue
            os.kill(pid, signal.SIGKILL)
        reap()
        return names

    def around(self):
        """What must stay: the canary by its bytes, the checkout's files by size and time of change."""
        seen = {str(path): hashlib.sha256(path.read_bytes()).hexdigest() for path in sorted(self.canary.rglob("*"))}
        for folder, folders, files in os.walk(SOURCE):
            folders[:] = [name for name in folders if name not in (".git", "build", "out", "__pycache__")]
            for name in files:
                try:
                    status = os.lstat(os.path.join(folder, name))
                except OSError:
                    continue
                seen[os.path.join(folder, name)] = (status.st_size, status.st_mtime_ns, status.st_mode)
        return seen

    def changed(self, keeps_tmp):
        """Sentences about what changed outside the output folder."""
        after = self.around()
        said = [f"{path} changed or vanished" for path, value in self.before.items() if after.get(path) != value]
        said += [f"{path} is new" for path in after if path not in self.before]
        said += [f"{path} was left in the working folder" for path in self.work.iterdir()]
        if not keeps_tmp:
            said += [f"{path} was left in TMPDIR" for path in self.tmp.iterdir()]
        return said

    def acts(self):
        """How often a hostile driver did something."""
        return (self.hostile / "acts").stat().st_size // 2 if (self.hostile / "acts").exists() else 0

    def mount(self, name, size):
        """A disk of so many bytes at a folder of the place. False where mounting is refused."""
        if libc.mount(b"tmpfs", bytes(getattr(self, name)), b"tmpfs", 0, f"size={size},mode=777".encode()) != 0:
            return False
        self.mounted.append(name)
        return True

    def protect(self, name):
        """Makes a mounted disk read-only; refused while a file there is open for writing."""
        return libc.mount(b"tmpfs", bytes(getattr(self, name)), b"tmpfs", MS_REMOUNT | MS_RDONLY, b"") == 0

    def enlarge(self, name):
        """The end of a disk's trouble: writable and large."""
        libc.mount(b"tmpfs", bytes(getattr(self, name)), b"tmpfs", MS_REMOUNT, b"size=256m")

    def remove(self):
        for name in self.mounted:
            libc.umount2(bytes(getattr(self, name)), MNT_DETACH)
        shutil.rmtree(self.root, ignore_errors=True)


def reap():
    try:
        while os.waitpid(-1, os.WNOHANG)[0] > 0:
            pass
    except ChildProcessError:
        pass


def status_of(pid):
    """State and parent of a process; ("Z", 0) if it is gone."""
    try:
        words = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
        return words[0], int(words[1])
    except OSError:
        return "Z", 0


def resident_bytes(pid):
    try:
        return int(pathlib.Path(f"/proc/{pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, IndexError):
        return 0
