# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""What scripts/run-suite hands to 'edgecase run', what scripts/install-packages and scripts/compare-results say, and
what is installed."""
import json
import os
import pathlib
import pty
import re
import shutil
import subprocess
import tempfile
import unittest

from support import PROGRAM, SOURCE


class RunSuite(unittest.TestCase):
    def setUp(self):
        self.root = pathlib.Path(tempfile.mkdtemp(prefix="edgecase-e2e-"))
        self.addCleanup(shutil.rmtree, self.root, ignore_errors=True)
        (self.root / "sub").mkdir()
        for name, text in (("scripts/install-packages", "exit 7"), ("scripts/build", "exit 0"),
                           ("build/release/bin/edgecase", 'printf "%s\\n" "$0" "$PWD" "$@"')):
            path = self.root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(f"#!/bin/sh\n{text}\n")
            path.chmod(0o755)
        shutil.copy(SOURCE / "scripts/run-suite", self.root / "scripts/run-suite")

    def words(self, *words, folder=".", **variables):
        env = {k: v for k, v in os.environ.items() if not k.startswith(("EDGECASE_", "VK_"))} | variables
        done = subprocess.run([self.root / "scripts/run-suite", *words], env=env, cwd=self.root / folder,
                              capture_output=True, text=True, timeout=60, check=True)
        program, where, *given = done.stdout.splitlines()
        self.assertEqual(os.path.realpath(where), os.path.realpath(self.root / folder))
        self.assertTrue((self.root / folder / program).exists(), program)
        return given

    def test_lavapipe_unless_another_is_chosen(self):
        self.assertEqual(self.words(), ["run", "--device", "llvmpipe", "-o", "out/suite"])
        for name in ("EDGECASE_DEVICE", "EDGECASE_ICD", "VK_DRIVER_FILES", "VK_ICD_FILENAMES"):
            self.assertEqual(self.words(**{name: "x"}), ["run", "-o", "out/suite"], name)
        for word in ("--device=x", "--icd=x", "--renderer=tiles"):
            self.assertEqual(self.words(word), ["run", "-o", "out/suite", word])

    def test_a_resumed_run_gets_nothing_of_its_own(self):
        self.assertEqual(self.words("--resume", "x"), ["run", "--resume", "x"])

    def test_paths_count_from_the_folder_of_the_caller(self):
        self.assertEqual(self.words("mine.toml", folder="sub"),
                         ["run", "--device", "llvmpipe", "-o", "../out/suite", "mine.toml"])
        self.assertEqual(self.words("-o", "here", folder="sub"), ["run", "--device", "llvmpipe", "-o", "here"])

    def test_nothing_is_installed_if_cmake_finds_all(self):
        self.assertEqual(self.words(), ["run", "--device", "llvmpipe", "-o", "out/suite"])  # install-packages would fail
        (self.root / "scripts/build").write_text('#!/bin/sh\n[ "$2" != --only-configure ]\n')
        done = subprocess.run([self.root / "scripts/run-suite"], capture_output=True, timeout=60, check=False)
        self.assertEqual((done.returncode, done.stdout), (7, b""))

    def test_nothing_is_installed_if_the_build_folder_is_anothers(self):
        (self.root / "scripts/build").write_text('#!/bin/sh\necho "error: moved" >&2\nexit 2\n')
        done = subprocess.run([self.root / "scripts/run-suite"], capture_output=True, timeout=60, check=False)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (2, b"", b"error: moved\n"))


class CompareResults(unittest.TestCase):
    CASE = {"id": "a", "status": "fail", "reason": "no line", "seconds": 1.0, "worst_quantity": "depth at pixel (1, 2)",
            "findings": [{"quantity": "attribute 0.x", "expected": "1 or near it", "got": "0x3f800000 (1)", "why": "so"}]}

    def setUp(self):
        self.root = pathlib.Path(tempfile.mkdtemp(prefix="edgecase-e2e-"))
        self.addCleanup(shutil.rmtree, self.root, ignore_errors=True)

    def compared(self, *options, finding=None, **changed):
        after = self.CASE | changed | {"findings": [self.CASE["findings"][0] | (finding or {})]}
        for name, case in (("before", self.CASE), ("after", after)):
            (self.root / name).mkdir(exist_ok=True)
            (self.root / name / "results.json").write_text(json.dumps({"cases": [case]}))
        done = subprocess.run([SOURCE / "scripts/compare-results", *options, self.root / "before", self.root / "after"],
                              capture_output=True, text=True, timeout=60, check=False)
        return done.returncode

    def test_times_never_differ_and_words_unless_they_are_left_out(self):
        self.assertEqual(self.compared(seconds=2.0), 0)
        for words in ({"reason": "other words"}, {"worst_quantity": "pixel (1, 2): depth"},
                      {"finding": {"why": "thus"}}, {"finding": {"expected": "nearly 1"}}):
            self.assertEqual(self.compared(**words), 1, words)
            self.assertEqual(self.compared("--no-words", **words), 0, words)

    def test_results_differ_without_words_too(self):
        for result in ({"status": "pass"}, {"worst_quantity": "depth at pixel (1, 3)"},
                       {"finding": {"quantity": "attribute 1.x"}}, {"finding": {"got": "0x3f800001 (1)"}},
                       {"finding": {"expected": "1.5 or near it"}}):
            self.assertEqual(self.compared("--no-words", **result), 1, result)

    def test_two_folders_are_compared(self):
        self.assertEqual(subprocess.run([SOURCE / "scripts/compare-results", "--no-words", self.root],
                                        capture_output=True, timeout=60, check=False).returncode, 2)


class Build(unittest.TestCase):
    """What scripts/build tells, with a CMake that ends when it is told to."""

    def setUp(self):
        self.root = pathlib.Path(tempfile.mkdtemp(prefix="edgecase-e2e-"))
        self.addCleanup(shutil.rmtree, self.root, ignore_errors=True)
        for folder in ("scripts", "bin", "build/release"):
            (self.root / folder).mkdir(parents=True)
        shutil.copy(SOURCE / "scripts/build", self.root / "scripts/build")
        cmake = self.root / "bin/cmake"
        cmake.write_text(f"""#!/bin/sh
if [ "$1" = --build ]; then
    echo '[3/7] compiling'
    until [ -e {self.root}/go ]; do sleep 0.1; done
    echo 'the error'
    [ ! -e {self.root}/fail ]
fi
""")
        cmake.chmod(0o755)
        self.env = os.environ | {"PATH": f"{self.root / 'bin'}:{os.environ['PATH']}"}

    def test_on_a_terminal_it_tells_how_far_it_is(self):
        ours, theirs = pty.openpty()
        program = subprocess.Popen([self.root / "scripts/build", "release"], env=self.env, stdout=theirs, stderr=theirs)
        os.close(theirs)
        text = b""
        while b"[3/7]" not in text:
            text += os.read(ours, 1000)
        (self.root / "go").touch()
        self.assertEqual(program.wait(timeout=60), 0)
        self.assertIn(b"building preset release for the first time, which takes some minutes", text)
        os.close(ours)

    def built(self, *words):
        return subprocess.run([self.root / "scripts/build", *words], env=self.env, capture_output=True, text=True, timeout=60, check=False)

    def test_a_checkout_that_was_moved_or_copied(self):
        (self.root / "go").touch()
        cache = self.root / "build/release/CMakeCache.txt"
        for home, code in ((self.root, 0), (self.root / "scripts/..", 0), (self.root / "gone", 2), (self.root / "bin", 2)):
            cache.write_text(f"CMAKE_BUILD_TYPE:STRING=Release\nCMAKE_HOME_DIRECTORY:INTERNAL={home}\n")
            done = self.built("release")
            self.assertEqual(done.returncode, code, home)
            wrong = (f"error: build/release was made for {home}, and this checkout is {self.root}: take it away (rm -r "
                     f"{self.root}/build/release) and build again\n")
            self.assertEqual(done.stderr, wrong if code else "")

    def test_what_the_tests_need_is_said(self):
        """Real CMake, to which googletest is not there."""
        done = subprocess.run(["cmake", "-S", SOURCE, "-B", self.root / "other", "-G", "Ninja", "-DEDGECASE_TESTS=ON",
                               "-DCMAKE_DISABLE_FIND_PACKAGE_GTest=ON"], capture_output=True, text=True, timeout=280, check=False)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("scripts/install-packages scripts/packages.txt scripts/packages-tests.txt", " ".join(done.stderr.split()))

    def test_elsewhere_it_is_quiet_but_for_errors(self):
        (self.root / "go").touch()
        (self.root / "build/release/.ninja_log").touch()
        done = self.built("release")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "building preset release\n", ""))
        (self.root / "fail").touch()
        done = self.built("release")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (1, "building preset release\n", "the error\n"))


class Help(unittest.TestCase):
    def test_every_script_says_what_it_takes(self):
        """In a folder of their own, where nothing else can be done."""
        root = pathlib.Path(tempfile.mkdtemp(prefix="edgecase-e2e-"))
        self.addCleanup(shutil.rmtree, root, ignore_errors=True)
        shutil.copytree(SOURCE / "scripts", root / "scripts")
        (root / "docs").mkdir()
        for name in ("doors.json", "cts-parity.toml", "cts-parity.json"):
            shutil.copy(SOURCE / "docs" / name, root / "docs" / name)
        scripts = [path for path in sorted((root / "scripts").iterdir()) if os.access(path, os.X_OK)]
        self.assertGreater(len(scripts), 15)
        for path in scripts:
            with self.subTest(path.name):
                done = subprocess.run([path, "--help"], cwd=root, capture_output=True, text=True, timeout=60, check=False)
                said = done.stdout + done.stderr
                self.assertNotIn("Traceback", said)
                self.assertGreater(len(said), 50)
                if path.name != "generate-docs":  # takes nothing
                    self.assertRegex(said, rf"usage: (scripts/)?{path.name}")
                if path.read_text().startswith("#!/usr/bin/env bash"):
                    self.assertEqual((done.returncode, done.stderr), (0, ""))
                    self.assertNotIn("set -euo", said)
        self.assertEqual(sorted(path.name for path in root.iterdir()), ["docs", "scripts"])


class CompareSpeed(unittest.TestCase):
    """scripts/compare-speed in a repository of its own, whose commits build programs of known cost."""

    def setUp(self):
        self.root = pathlib.Path(tempfile.mkdtemp(prefix="edgecase-e2e-"))
        self.addCleanup(shutil.rmtree, self.root, ignore_errors=True)
        (self.root / "scripts").mkdir()
        shutil.copy(SOURCE / "scripts/compare-speed", self.root / "scripts/compare-speed")
        self.git("init", "-q")
        for name, megabytes in (("light", 4), ("heavy", 160)):
            self.build_is(f"print(len(bytearray({megabytes} << 20)))", name)

    def git(self, *words):
        subprocess.run(["git", "-C", self.root, "-c", "user.name=t", "-c", "user.email=t@example.com", *words],
                       check=True, capture_output=True)

    def build_is(self, program, tag):
        build = self.root / "scripts/build"
        build.write_text("#!/bin/sh\ncd \"$(dirname \"$0\")/..\" && mkdir -p build/release/bin && "
                         f"printf '#!/usr/bin/env python3\\n{program}\\n' >build/release/bin/edgecase && "
                         "chmod +x build/release/bin/edgecase\n")
        build.chmod(0o755)
        self.git("add", "-A")
        self.git("commit", "-q", "-m", tag)
        self.git("tag", tag)

    def told(self, *words):
        done = subprocess.run([self.root / "scripts/compare-speed", *words], capture_output=True, text=True,
                              timeout=120, check=False)
        return done.returncode, done.stdout, done.stderr

    def test_pairs_of_two_commits(self):
        code, out, err = self.told("light", "heavy", "--pairs", "2", "--", "run", "--quick")
        self.assertEqual((code, err), (0, ""))
        self.assertIn("edgecase run --quick, 2 pairs: medians of light and heavy", out)
        ratios = {line.split("  ")[1].strip(): float(line.split()[-4]) for line in out.splitlines()[1:]}
        self.assertEqual(set(ratios), {"wall s", "processor s", "largest process MB"})
        self.assertGreater(ratios["largest process MB"], 4)  # the memory of a process is no matter of a machine's hour

    def test_wrong_use(self):
        for words, said in ((("nosuch", "heavy"), "'nosuch' is no commit of this repository"),
                            (("light", "heavy", "--pairs", "0"), "--pairs takes a whole number from 1 to 100"),
                            (("light",), "required: b")):
            code, out, err = self.told(*words)
            self.assertEqual((code, out), (2, ""), words)
            self.assertIn(said, err)

    def test_what_does_not_build(self):
        build = self.root / "scripts/build"
        build.write_text("#!/bin/sh\nexit 1\n")
        self.git("commit", "-q", "-a", "-m", "broken")
        code, _, err = self.told("light", "HEAD")
        self.assertEqual(code, 1)
        self.assertIn("HEAD does not build", err)


class InstallPackages(unittest.TestCase):
    """On a machine with these commands alone (a PATH of its own)."""

    def say(self, *commands, lists=("scripts/packages.txt",), **stubs):
        with tempfile.TemporaryDirectory(prefix="edgecase-e2e-") as folder:
            for name in ("env", "bash", "cut", "sed", "grep", "mktemp", "rm", "cat", *commands):
                (pathlib.Path(folder) / name).symlink_to(shutil.which(name))
            for name, text in stubs.items():
                path = pathlib.Path(folder) / name.replace("_", "-")
                path.write_text(f"#!/bin/sh\n{text}\n")
                path.chmod(0o755)
            return subprocess.run([SOURCE / "scripts/install-packages", *lists], env={"PATH": folder}, cwd=SOURCE,
                                  capture_output=True, text=True, timeout=60, check=False)

    def test_without_apt(self):
        head = "error: something that building or running needs is missing, and there is no apt-get to install it; install:\n    "
        for manager, command in (("dnf", "sudo dnf install gcc-c++ cmake ninja-build "),
                                 ("pacman", "sudo pacman -S --needed gcc cmake ninja pkgconf "),
                                 ("other", "the packages that Debian calls g++ cmake ninja-build ")):
            done = self.say(**{manager: "exit 9"})
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertTrue(done.stderr.startswith(head + command), done.stderr)
            self.assertEqual(done.stderr.count("\n"), 2)

    def test_without_root(self):
        done = self.say(apt_get="exit 9", id="echo 1000", dpkg_query='[ "$4" != mold ] && echo installed')
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertEqual(done.stderr, "error: packages are missing and neither root nor sudo is at hand; as root, run:\n"
                         "    apt-get install -y --no-install-recommends mold\n")
        self.assertEqual(self.say(apt_get="exit 9", id="echo 1000", dpkg_query="echo installed").returncode, 0)

    def test_the_table_lacks_no_package(self):
        needed = [line.split()[0] for line in (SOURCE / "scripts/packages.txt").read_text().splitlines()
                  if line[:1] not in ("", "#") and "(optional)" not in line]
        self.assertEqual(self.say().stderr.split(" calls ")[1].split(), needed)


class Elsewhere(unittest.TestCase):
    """A machine that is not set up as scripts/install-packages does it."""

    def test_neither_compiler_nor_launcher_nor_image_library_is_demanded(self):
        presets = json.loads((SOURCE / "CMakePresets.json").read_text())["configurePresets"]
        for preset in presets:
            if preset["name"] in ("base", "dev", "release"):
                self.assertEqual({k for k in preset["cacheVariables"] if "COMPILER" in k or "LAUNCHER" in k}, set())
        with tempfile.TemporaryDirectory(prefix="edgecase-e2e-") as build:
            # No library is found by pkg-config, so OpenImageIO is not there; the compiler is the one that CXX names.
            compiler = shutil.which("clang++") or shutil.which("c++")
            env = {k: v for k, v in os.environ.items() if k != "CMAKE_CXX_COMPILER_LAUNCHER"}
            done = subprocess.run(["cmake", "-S", SOURCE, "-B", build, "-G", "Ninja", "-DEDGECASE_TESTS=OFF", "-DEDGECASE_CCACHE="],
                                  env=env | {"PKG_CONFIG_LIBDIR": build, "CXX": compiler}, capture_output=True, text=True,
                                  timeout=120, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            built = (pathlib.Path(build) / "build.ninja").read_text()
            rules = (pathlib.Path(build) / "CMakeFiles/rules.ninja").read_text()
        compiles = re.findall(r"^  command = (\S+) \$DEFINES", rules, re.M)
        self.assertEqual(set(compiles), {compiler})
        self.assertEqual(re.findall(r"^build .*edgecase-image-io", built, re.M), [])


class Installed(unittest.TestCase):
    """What 'cmake --install' leaves, moved elsewhere."""

    def test_a_moved_prefix_has_all(self):
        root = pathlib.Path(tempfile.mkdtemp(prefix="edgecase-e2e-"))
        self.addCleanup(shutil.rmtree, root, ignore_errors=True)
        build = pathlib.Path(PROGRAM).resolve().parents[1]
        done = subprocess.run(["cmake", "--install", build, "--prefix", root / "here"], check=True, capture_output=True, text=True, timeout=120)
        # An installation that is cut off has no program: a cache of it is not taken for a whole one.
        self.assertTrue(done.stdout.rstrip().endswith("here/bin/edgecase"), done.stdout[-200:])
        moved = (root / "here").rename(root / "elsewhere")
        env = {k: v for k, v in os.environ.items() if not k.startswith("EDGECASE_")}

        def edgecase(*words):
            done = subprocess.run([moved / "bin/edgecase", *words], env=env, cwd=root, capture_output=True, text=True,
                                  timeout=120, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            return done.stdout

        files = {case["file"] for case in json.loads(edgecase("list", "--json"))}
        self.assertEqual({f for f in files if not f.startswith(f"{moved}/share/edgecase/cases/suite/")}, set())
        self.assertEqual(len(files), len(list((SOURCE / "cases/suite").rglob("*.toml"))))
        self.assertIn("1 pass", edgecase("run", "ties/apex-up", "--renderer=reference", "-o", "out"))
        edgecase("render", "ties/apex-up", "-o", "x.png")
        self.assertEqual((root / "x.png").read_bytes()[:4], b"\x89PNG")
        self.assertIn(f"{moved}/bin/../lib/edgecase/edgecase-image-io.so", edgecase("doctor", "--renderer=reference"))
        for kept, source in (("share/edgecase/cases/expectations", "cases/expectations"), ("share/edgecase/schema", "docs/schema"),
                             ("share/edgecase/ci", "docs/ci")):
            self.assertEqual(sorted(p.name for p in (moved / kept).iterdir()), sorted(p.name for p in (SOURCE / source).iterdir()))
        self.assertTrue(os.access(moved / "share/edgecase/ci/bisect-bits", os.X_OK))
        for page in ("man/man1/edgecase.1", "bash-completion/completions/edgecase", "zsh/site-functions/_edgecase",
                     "fish/vendor_completions.d/edgecase.fish"):
            self.assertGreater((moved / "share" / page).stat().st_size, 1000)


@unittest.skipUnless(shutil.which("dpkg-shlibdeps"), "dpkg-shlibdeps is missing")
class Packed(unittest.TestCase):
    """The package of Debian that cpack makes; scripts/package --check installs it in a clean root."""

    def test_an_unpacked_package_is_a_whole_tool(self):
        build = pathlib.Path(PROGRAM).resolve().parents[1]
        if "-fsanitize" in (build / "build.ninja").read_text(encoding="utf-8"):
            self.skipTest("a program under sanitizers is not packed")
        root = pathlib.Path(tempfile.mkdtemp(prefix="edgecase-e2e-"))
        self.addCleanup(shutil.rmtree, root, ignore_errors=True)
        done = subprocess.run(["cpack", "--config", build / "CPackConfig.cmake", "-G", "DEB", "-B", root / "packed"], cwd=root,
                              capture_output=True, text=True, timeout=300, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        package, = (root / "packed").glob("*.deb")
        control = subprocess.run(["dpkg-deb", "--field", package, "Package", "Depends", "Recommends"], check=True,
                                 capture_output=True, text=True).stdout
        for word in ("edgecase", "libvulkan1", "libc6 (", "libopenimageio", "mesa-vulkan-drivers"):
            self.assertIn(word, control)
        self.assertNotIn("libgmp", control)  # linked in, so that the package installs beside any
        subprocess.run(["dpkg-deb", "-x", package, root / "there"], check=True)
        program = root / "there/usr/bin/edgecase"
        for built in (program, root / "there/usr/lib/edgecase/edgecase-image-io.so"):
            self.assertNotIn(str(SOURCE).encode(), built.read_bytes(), f"{built} tells where it was built")
        env = {k: v for k, v in os.environ.items() if not k.startswith("EDGECASE_")}
        done = subprocess.run([program, "run", "scissor/changes", "multisample/scissor", "-o", "out"], env=env, cwd=root,
                              capture_output=True, text=True, timeout=120, check=False)
        # Expected failures among them: the package has the expectation files, and the pages that they name.
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        results = json.loads((root / "out/results.json").read_text(encoding="utf-8"))
        self.assertGreater(results["totals"]["xfail"], 0)
        for page in {case["bug"] for case in results["cases"] if case["status"] == "xfail"}:
            self.assertTrue((root / "there/usr/share/edgecase" / page).is_file(), page)


if __name__ == "__main__":
    unittest.main()
