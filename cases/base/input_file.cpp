// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/base/input_file.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "cases/base/limits.hpp"

namespace cases {

namespace fs = std::filesystem;

namespace {

constexpr size_t kMostBytes = size_t{256} << 20U;

tl::unexpected<Error> too_large() {
    return failure("it is larger than {} MiB", kMostBytes >> 20U);
}

Expected<std::string> read_all(int fd) {
    std::string text;
    std::array<char, 65536> piece;
    while (text.size() <= kMostBytes) {
        const ssize_t count = ::read(fd, piece.data(), piece.size());
        if (count == 0) {
            return text;
        }
        if (count > 0) {
            text.append(piece.data(), static_cast<size_t>(count));
        } else if (errno == EAGAIN) {  // a pipe whose writer is not ready
            pollfd ready{fd, POLLIN, 0};
            ::poll(&ready, 1, -1);
        } else if (errno != EINTR) {
            return failure(std::strerror(errno));
        }
    }
    return too_large();
}

}  // namespace

Expected<std::string> read_file(const fs::path& file, Pipes pipes) {
    // Without O_NONBLOCK, opening a pipe waits for its writer.
    const int fd = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (fd < 0) {
        throw_if_limit(errno);
        return failure(std::strerror(errno));
    }
    struct stat status {};
    const bool is_known = ::fstat(fd, &status) == 0;
    const bool is_taken =
        is_known && (S_ISREG(status.st_mode) || (pipes == Pipes::read && S_ISFIFO(status.st_mode)));
    Expected<std::string> text = failure("it is a folder, a pipe or a device");
    if (is_taken) {
        text = status.st_size > off_t{kMostBytes} ? too_large() : read_all(fd);
    }
    ::close(fd);
    return text;
}

Expected<fs::path> place_inside(const fs::path& folder, const fs::path& file) {
    std::error_code error;
    const fs::path root = fs::canonical(folder, error);
    const fs::path place = error ? fs::path() : fs::canonical(file, error);
    if (error) {
        return failure(error.message());
    }
    if (*place.lexically_relative(root).begin() == "..") {
        return failure("a link leads out of the folder '{}'", folder.string());
    }
    return place;
}

Expected<std::string> read_inside(const fs::path& folder, const fs::path& file) {
    const Expected<fs::path> place = place_inside(folder, file);
    return place ? read_file(*place) : Expected<std::string>(tl::unexpected(place.error()));
}

}  // namespace cases
