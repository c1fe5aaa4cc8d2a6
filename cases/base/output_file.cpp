// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/base/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>

#include "cases/base/printable.hpp"

namespace cases {

namespace fs = std::filesystem;

namespace {

tl::unexpected<Error> system_failure() {
    return failure(std::string(std::strerror(errno)));
}

// Closes a descriptor: some file systems tell of a full disk only now.
Expected<void> close_told(int fd) {
    return ::close(fd) == 0 ? Expected<void>() : system_failure();
}

Expected<void> write_in_place(const fs::path& file, const Tell& tell) {
    const int fd = ::open(file.c_str(), O_WRONLY | O_TRUNC | O_NOCTTY | O_CLOEXEC);
    if (fd < 0) {
        return system_failure();
    }
    const Expected<void> written = write_to(fd, tell);
    const Expected<void> closed = close_told(fd);
    return written ? closed : written;
}

// A file that is not in its place yet. It has no name where the file system can do that, so that
// nothing is left of it when the program is killed.
class NewFile {
  public:
    explicit NewFile(const fs::path& folder) : folder_(folder) {
        if (::access("/proc/self/fd", X_OK) == 0) {  // what names it
            fd_ = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
        }
        if (fd_ < 0) {
            with_free_name([&](const fs::path& name) {
                fd_ = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
                return fd_ >= 0;
            });
        }
    }
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;
    ~NewFile() {
        if (fd_ >= 0) {
            ::close(fd_);
        }
        if (!name_.empty()) {
            ::unlink(name_.c_str());
        }
    }

    int fd() const { return fd_; }

    // Gives it the owner and the permissions of an older file; false: it cannot have that owner.
    bool take_over(const struct stat& old) const {
        struct stat now {};
        const bool is_owned =
            ::fstat(fd_, &now) == 0 && ((now.st_uid == old.st_uid && now.st_gid == old.st_gid) ||
                                        ::fchown(fd_, old.st_uid, old.st_gid) == 0);
        return is_owned && ::fchmod(fd_, old.st_mode & 0777U) == 0;
    }

    Expected<void> take_place(const fs::path& file) {
        if (name_.empty()) {
            const std::string link = "/proc/self/fd/" + std::to_string(fd_);
            const auto is_linked = [&link](const fs::path& name) {
                return ::linkat(AT_FDCWD, link.c_str(), AT_FDCWD, name.c_str(),
                                AT_SYMLINK_FOLLOW) == 0;
            };
            if (is_linked(file)) {
                return close_told(std::exchange(fd_, -1));
            }
            // rename() alone replaces a file, so this one needs a name for a moment.
            if (errno != EEXIST || !with_free_name(is_linked)) {
                return system_failure();
            }
        }
        if (auto closed = close_told(std::exchange(fd_, -1)); !closed) {
            return closed;
        }
        if (::rename(name_.c_str(), file.c_str()) != 0) {
            return system_failure();
        }
        name_.clear();
        return {};
    }

  private:
    // Whether `make` made something of a name that nobody had.
    bool with_free_name(const std::function<bool(const fs::path&)>& make) {
        static std::atomic<unsigned> number{0};
        do {
            const fs::path name = folder_ / (".edgecase-" + std::to_string(::getpid()) + "-" +
                                             std::to_string(number++));
            if (make(name)) {
                name_ = name;
                return true;
            }
        } while (errno == EEXIST);
        return false;
    }

    fs::path folder_;
    fs::path name_;  // empty: none
    int fd_ = -1;
};

// Where links lead from a file, which need not be there. What the kernel keeps as a link is told by
// the links of /proc alone; a name that leads there (/dev/stdout) stays as it is.
fs::path followed(const fs::path& named) {
    constexpr int kMostLinks = 40;
    fs::path file = named;
    std::error_code none;
    for (int links = 0; links < kMostLinks && fs::is_symlink(file, none); ++links) {
        if (fs::weakly_canonical(file.parent_path(), none).string().starts_with("/proc/")) {
            return named;
        }
        file = file.parent_path() / fs::read_symlink(file, none);
    }
    return file;
}

}  // namespace

Expected<void> write_to(int fd, const Tell& tell) {
    constexpr size_t kAtOnce = size_t{1} << 16U;
    std::string waiting;
    int error = 0;
    const auto flush = [&] {
        size_t done = 0;
        while (error == 0 && done < waiting.size()) {
            const ssize_t count = ::write(fd, waiting.data() + done, waiting.size() - done);
            if (count >= 0) {
                done += static_cast<size_t>(count);
            } else if (errno != EINTR) {
                error = errno;
            }
        }
        waiting.clear();
    };
    tell([&](std::string_view piece) {
        waiting += piece;
        if (waiting.size() >= kAtOnce) {
            flush();
        }
    });
    flush();
    errno = error;
    return error == 0 ? Expected<void>() : system_failure();
}

Expected<void> write_file(const fs::path& named, Link link, const Tell& tell) {
    const bool keeps = link == Link::followed;
    const fs::path file = keeps ? followed(named) : named;
    struct stat old {};
    const bool is_there = ::lstat(file.c_str(), &old) == 0;
    if (keeps && is_there) {
        if (!S_ISREG(old.st_mode)) {
            return write_in_place(file, tell);
        }
        if (::faccessat(AT_FDCWD, file.c_str(), W_OK, AT_EACCESS) != 0) {
            return system_failure();
        }
    }
    NewFile fresh(file.has_parent_path() ? file.parent_path() : fs::path("."));
    if (fresh.fd() < 0) {
        const bool is_closed = errno == EACCES || errno == EPERM || errno == EROFS;
        return keeps && is_there && is_closed ? write_in_place(file, tell) : system_failure();
    }
    if (keeps && is_there && !fresh.take_over(old)) {
        return write_in_place(file, tell);
    }
    if (auto written = write_to(fresh.fd(), tell); !written) {
        return written;
    }
    Expected<void> placed = fresh.take_place(file);
    if (!placed && keeps && errno == EBUSY) {  // a file that is a mount, as containers have them
        return write_in_place(file, tell);
    }
    return placed;
}

Expected<void> make_folders(const fs::path& folder, const fs::path& file) {
    std::error_code error;
    fs::create_directories(folder, error);
    fs::path at = folder;
    const fs::path below = file.lexically_relative(folder).parent_path();
    for (auto part = below.begin(); !error && part != below.end(); ++part) {
        at /= *part;
        const fs::file_type type = fs::symlink_status(at, error).type();
        if (type == fs::file_type::not_found) {
            fs::create_directory(at, error);
        } else if (!error && type != fs::file_type::directory) {
            return failure("the folder '{}' cannot be made: a link or a file has its name",
                           printable(at.string()));
        }
    }
    return error ? failure("the folder '{}' cannot be made: {}", printable(at.string()),
                           error.message())
                 : Expected<void>();
}

}  // namespace cases
