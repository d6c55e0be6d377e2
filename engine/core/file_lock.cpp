#include "engine/core/file_lock.h"

#include <cerrno>
#include <fcntl.h>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace anvil {

namespace {

/// Whether the name still stands for the open file: who held it before may have removed it.
bool is_still_there(int file, const std::filesystem::path& path) {
    struct stat open {};
    struct stat named {};
    return ::fstat(file, &open) == 0 && ::stat(path.c_str(), &named) == 0 && open.st_ino == named.st_ino &&
           open.st_dev == named.st_dev;
}

bool lock(int file, int how) {
    int result = 0;
    do {
        result = ::flock(file, how);
    } while (result != 0 && errno == EINTR);
    return result == 0;
}

} // namespace

std::optional<FileLock> FileLock::wait_for(const std::filesystem::path& path) {
    for (;;) {
        const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (file < 0) {
            return std::nullopt;
        }
        FileLock held(file);
        if (!lock(file, LOCK_EX)) {
            return std::nullopt;
        }
        if (is_still_there(file, path)) {
            return held;
        }
    }
}

std::optional<FileLock> FileLock::take_over(const std::filesystem::path& path) {
    const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
    if (file < 0) {
        return std::nullopt;
    }
    FileLock held(file);
    return lock(file, LOCK_EX | LOCK_NB) && is_still_there(file, path) ? std::optional(std::move(held))
                                                                       : std::nullopt;
}

std::optional<FileLock> FileLock::make(const std::filesystem::path& path) {
    // Held under another name first: who sees it under this one finds it held.
    const std::filesystem::path unseen = path.string() + ".new";
    const int file = ::open(unseen.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0) {
        return std::nullopt;
    }
    FileLock held(file);
    const bool made = lock(file, LOCK_EX | LOCK_NB) && ::link(unseen.c_str(), path.c_str()) == 0;
    ::unlink(unseen.c_str());
    return made ? std::optional(std::move(held)) : std::nullopt;
}

FileLock::FileLock(FileLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
    std::swap(file_, other.file_);
    return *this;
}

FileLock::~FileLock() {
    if (file_ >= 0) {
        ::close(file_);
    }
}

} // namespace anvil
