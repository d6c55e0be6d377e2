// A file that one process at a time holds; the system lets go of it when the process ends, however it ends.
#pragma once

#include <filesystem>
#include <optional>

namespace anvil {

class FileLock {
  public:
    /// Waits for the file, which is made if it is not there; nothing if it cannot be made or locked.
    static std::optional<FileLock> wait_for(const std::filesystem::path& path);

    /// Nothing if the file is not there, another holds it, or it cannot be locked.
    static std::optional<FileLock> take_over(const std::filesystem::path& path);

    /// A new file with this name that is held from the moment it can be seen; nothing if it cannot be made or
    /// is there already.
    static std::optional<FileLock> make(const std::filesystem::path& path);

    FileLock(FileLock&& other) noexcept;
    FileLock& operator=(FileLock&& other) noexcept;
    ~FileLock();

  private:
    explicit FileLock(int file) : file_(file) {}

    int file_;
};

} // namespace anvil
