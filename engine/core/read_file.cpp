#include "engine/core/read_file.h"

#include "engine/core/error.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace anvil {

namespace {

struct Descriptor {
    int number;
    ~Descriptor() {
        if (number >= 0) {
            ::close(number);
        }
    }
};

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& cause, const std::string& mend) {
    throw InputError(path.string() + ": " + cause + "; " + mend);
}

} // namespace

std::string read_file(const std::filesystem::path& path) {
    // O_NONBLOCK: opening a pipe that nobody writes to would wait for ever.
    const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
    struct stat about {};
    if (file.number < 0 || ::fstat(file.number, &about) != 0) {
        const int code = errno;
        fail(path, std::string("cannot be opened: ") + std::strerror(code),
             code == EACCES ? "allow reading it or name another file" : "check the path");
    }
    if (S_ISDIR(about.st_mode)) {
        fail(path, "is a directory", "name a file in it");
    }
    if (!S_ISREG(about.st_mode)) {
        fail(path, "is not a regular file", "save its content to a file first");
    }
    std::string bytes(static_cast<size_t>(about.st_size), '\0');
    size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t got = ::read(file.number, bytes.data() + done, bytes.size() - done);
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got < 0) {
            fail(path, std::string("cannot be read: ") + std::strerror(errno), "check the disk");
        }
        if (got == 0) {
            break;
        }
        done += static_cast<size_t>(got);
    }
    bytes.resize(done);
    return bytes;
}

} // namespace anvil
