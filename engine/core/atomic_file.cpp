#include "engine/core/atomic_file.h"

#include "engine/core/error.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <unistd.h>

namespace anvil {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, int code) {
    const char* mend = code == ENOENT   ? "create its folder first"
                       : code == ENOSPC ? "free some space"
                       : code == EISDIR ? "name a file in it"
                                        : "choose another place";
    throw WriteError(path.string() + ": cannot be written: " + std::strerror(code) + "; " + mend);
}

/// 0 or the error's number.
int write_all(int file, std::string_view content) {
    while (!content.empty()) {
        const ssize_t written = ::write(file, content.data(), content.size());
        if (written < 0 && errno != EINTR) {
            return errno;
        }
        content.remove_prefix(written > 0 ? static_cast<size_t>(written) : 0);
    }
    return 0;
}

int create_and_write(const fs::path& path, int flags, std::string_view content) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | flags, 0666);
    if (file < 0) {
        return errno;
    }
    const int code = write_all(file, content);
    // Some file systems report a full disk only here.
    return ::close(file) != 0 && code == 0 ? errno : code;
}

/// A short name of its own: a suffix to a long target name could exceed the file system's limit.
fs::path temporary_beside(const fs::path& path) {
    static std::atomic<unsigned> counter{0};
    const std::string name =
        ".anvil-" + std::to_string(::getpid()) + "-" + std::to_string(counter++) + ".tmp";
    return path.parent_path() / name;
}

} // namespace

void write_file_atomically(const fs::path& path, std::string_view content) {
    std::error_code ignored;
    const fs::path resolved = fs::canonical(path, ignored);
    const fs::path target = resolved.empty() ? path : resolved;
    const fs::file_status status = fs::status(target, ignored);
    if (fs::is_directory(status) || !target.has_filename()) {
        fail(path, EISDIR);
    }
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        if (const int code = create_and_write(target, 0, content)) {
            fail(path, code);
        }
        return;
    }
    const fs::path temporary = temporary_beside(target);
    int code = create_and_write(temporary, O_CREAT | O_EXCL, content);
    if (code == 0 && ::rename(temporary.c_str(), target.c_str()) != 0) {
        code = errno;
    }
    if (code != 0) {
        ::unlink(temporary.c_str());
        fail(path, code);
    }
}

void write_file_atomically(const fs::path& path, std::span<const std::byte> content) {
    write_file_atomically(path,
                          std::string_view(reinterpret_cast<const char*>(content.data()), content.size()));
}

} // namespace anvil
