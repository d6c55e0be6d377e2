// What can go wrong, by who can mend it. app/main turns each into an exit status (2, 3, 4, 1, 130).
#pragma once

#include <stdexcept>
#include <string>

namespace anvil {

/// Base of all errors that Anvil throws; what() is one readable sentence without a prefix.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The user's input: names the file, the place (line, byte, key), what was found and what would mend it.
class InputError : public Error {
  public:
    using Error::Error;
};

/// A Vulkan device or driver is missing, failed, or is too small.
class DeviceError : public Error {
  public:
    using Error::Error;
};

/// A file could not be written.
class WriteError : public Error {
  public:
    using Error::Error;
};

/// A fault of ours: a state that the code rules out.
class InternalError : public Error {
  public:
    using Error::Error;
};

/// The user or the caller stopped the work.
class Cancelled : public Error {
  public:
    Cancelled() : Error("interrupted") {}
};

} // namespace anvil
