// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "cases/base/input_file.hpp"
#include "cases/base/output_file.hpp"

namespace cases {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Files : public ::testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "edgecase-files-XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        dir_ = name;
    }
    void TearDown() override { fs::remove_all(dir_); }

    void put(const std::string& name, const std::string& text) const {
        std::ofstream(dir_ / name) << text;
    }
    std::string text(const std::string& name) const {
        std::ifstream in(dir_ / name);
        std::ostringstream all;
        all << in.rdbuf();
        return all.str();
    }
    std::vector<std::string> names() const {
        std::vector<std::string> all;
        for (const auto& entry : fs::directory_iterator(dir_)) {
            all.push_back(entry.path().filename());
        }
        std::sort(all.begin(), all.end());
        return all;
    }
    Expected<void> write(const std::string& name, Link link, const std::string& text) const {
        return write_file(dir_ / name, link, [&](const Put& put) { put(text); });
    }
    // How a child ends that does something: the exit code, or 128 and the signal.
    static int in_child(const auto& work) {
        const pid_t child = ::fork();
        if (child == 0) {
            ::_exit(work());
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    }

    fs::path dir_;
};

TEST_F(Files, a_file_that_cannot_grow_stays_as_it_was) {
    put("a", "old");
    for (const Link link : {Link::followed, Link::replaced}) {
        const int code = in_child([&] {
            std::signal(SIGXFSZ, SIG_IGN);
            const rlimit most{100'000, 100'000};
            ::setrlimit(RLIMIT_FSIZE, &most);
            const auto written = write("a", link, std::string(200'000, 'x'));
            return !written && written.error().message == "File too large" ? 0 : 1;
        });
        EXPECT_EQ(code, 0);
        EXPECT_EQ(text("a"), "old");
        EXPECT_THAT(names(), ElementsAre("a"));
    }
}

TEST_F(Files, a_program_that_is_killed_leaves_the_old_file_alone) {
    const int nameless = ::open(dir_.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
    if (nameless < 0) {
        GTEST_SKIP() << "this file system has no files without a name";
    }
    ::close(nameless);
    put("a", "old");
    for (const Link link : {Link::followed, Link::replaced}) {
        const int code = in_child([&] {
            return write_file(dir_ / "a", link,
                              [](const Put& put) {
                                  put(std::string(200'000, 'x'));
                                  ::raise(SIGKILL);
                              })
                       ? 0
                       : 1;
        });
        EXPECT_EQ(code, 128 + SIGKILL);
        EXPECT_EQ(text("a"), "old");
        EXPECT_THAT(names(), ElementsAre("a"));
    }
}

TEST_F(Files, a_file_that_is_named_is_written_where_its_link_leads) {
    fs::create_directory(dir_ / "below");
    put("below/a", "old");
    fs::permissions(dir_ / "below/a", fs::perms{0640});
    fs::create_symlink("below/a", dir_ / "link");
    fs::create_symlink("below/new", dir_ / "dangling");
    ASSERT_TRUE(write("link", Link::followed, "new"));
    ASSERT_TRUE(write("dangling", Link::followed, "made"));
    EXPECT_EQ(text("below/a"), "new");
    EXPECT_EQ(fs::status(dir_ / "below/a").permissions(), fs::perms{0640});
    EXPECT_EQ(text("below/new"), "made");
    EXPECT_TRUE(fs::is_symlink(dir_ / "link"));
    ASSERT_TRUE(write("link", Link::replaced, "other"));
    EXPECT_FALSE(fs::is_symlink(dir_ / "link"));
    EXPECT_EQ(text("below/a"), "new");
    EXPECT_THAT(names(), ElementsAre("below", "dangling", "link"));
}

TEST_F(Files, what_is_no_ordinary_file_is_written_as_it_is) {
    EXPECT_TRUE(write_file("/dev/null", Link::followed, [](const Put& put) { put("x"); }));
    EXPECT_EQ(
        write_file("/dev/full", Link::followed, [](const Put& put) { put("x"); }).error().message,
        "No space left on device");
    fs::create_symlink("/dev/full", dir_ / "full");
    EXPECT_FALSE(write("full", Link::followed, "x"));
    fs::create_directory(dir_ / "folder");
    EXPECT_EQ(write("folder", Link::followed, "x").error().message, "Is a directory");
    EXPECT_FALSE(write("folder", Link::replaced, "x"));
    EXPECT_THAT(names(), ElementsAre("folder", "full"));
    // A descriptor has a name, too: its file is not replaced.
    put("log", "line\n");
    const int fd = ::open((dir_ / "log").c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    struct stat before {};
    struct stat after {};
    ASSERT_EQ(::fstat(fd, &before), 0);
    EXPECT_TRUE(write_file("/dev/fd/" + std::to_string(fd), Link::followed,
                           [](const Put& put) { put("new"); }));
    ::close(fd);
    ASSERT_EQ(::stat((dir_ / "log").c_str(), &after), 0);
    EXPECT_EQ(before.st_ino, after.st_ino);
    EXPECT_EQ(text("log"), "new");
}

TEST_F(Files, where_no_new_file_can_stand_the_old_one_is_written) {
    put("a", "old");
    fs::permissions(dir_ / "a", fs::perms{0666});
    fs::permissions(dir_, fs::perms{0555});
    const int code = in_child([&] {
        if (::geteuid() == 0 && ::seteuid(65534) != 0) {
            return 2;
        }
        return write("a", Link::followed, "new") && !write("b", Link::followed, "new") &&
                       !write("a", Link::replaced, "newer")
                   ? 0
                   : 1;
    });
    fs::permissions(dir_, fs::perms{0755});
    EXPECT_EQ(code, 0);
    EXPECT_EQ(text("a"), "new");
}

TEST_F(Files, an_ordinary_file_alone_is_read) {
    put("a", std::string(200'000, 'x'));
    EXPECT_EQ(read_file(dir_ / "a")->size(), 200'000);
    ASSERT_EQ(::mkfifo((dir_ / "pipe").c_str(), 0600), 0);
    for (const fs::path& file : {dir_, dir_ / "pipe", fs::path("/dev/zero")}) {
        EXPECT_EQ(read_file(file).error().message, "it is a folder, a pipe or a device");
    }
    EXPECT_EQ(*read_file(dir_ / "pipe", Pipes::read), "");  // nobody writes into it
    EXPECT_EQ(read_file(dir_ / "nothing").error().message, "No such file or directory");
    fs::create_symlink("a", dir_ / "large");
    fs::resize_file(dir_ / "a", (uintmax_t{256} << 20U) + 1);
    EXPECT_EQ(read_file(dir_ / "large").error().message, "it is larger than 256 MiB");
}

TEST_F(Files, no_link_leads_out_of_a_folder) {
    fs::create_directories(dir_ / "given/found");
    put("outside", "secret");
    put("given/found/a", "own");
    const fs::path given = dir_ / "given";
    fs::create_symlink("../../outside", given / "found/b");
    fs::create_symlink("found/a", given / "c");
    fs::create_symlink("..", given / "d");
    fs::create_symlink("given", dir_ / "link");
    EXPECT_EQ(*read_inside(given, given / "c"), "own");
    EXPECT_EQ(*read_inside(dir_ / "link", dir_ / "link/found/a"), "own");
    for (const char* name : {"found/b", "d/outside", "../outside"}) {
        const auto read = read_inside(given, given / name);
        ASSERT_FALSE(read) << name;
        EXPECT_THAT(read.error().message, HasSubstr("a link leads out of the folder"));
    }
    EXPECT_TRUE(make_folders(given, given / "found/x/y/file"));
    EXPECT_TRUE(fs::is_directory(given / "found/x/y"));
    EXPECT_FALSE(make_folders(given, given / "d/x/file"));
    EXPECT_FALSE(make_folders(given, given / "found/a/file"));
    EXPECT_THAT(names(), ElementsAre("given", "link", "outside"));
}

}  // namespace
}  // namespace cases
