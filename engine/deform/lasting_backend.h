// A back end that outlasts its device.
#pragma once

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/deform/backend.h"
#include "engine/mesh/lasting_search.h"

#include <optional>

namespace anvil {

/// Computes with a device until that fails (lost, out of memory), from then on with the double-precision CPU
/// back end: it warns once, and what the failed call was to do is done there. Sessions go on where they were,
/// from their input and their last motion; each finds out for itself.
class LastingBackend final : public Backend {
  public:
    /// `device` and `log` outlive it.
    LastingBackend(Backend& device, Log& log);
    /// With a device of its own.
    LastingBackend(std::unique_ptr<Backend> device, Log& log);

    /// The sessions must not outlive it.
    std::unique_ptr<DeformSession> prepare(std::shared_ptr<const DeformInput> input) override;
    void warm(const DeformInput& input, const DeformMotion& motion) override; ///< the device, failed or not
    /// The device's, while that is good; its errors become warnings there too.
    SearchDevice* search_device() override;
    std::string device_name() const override;
    std::string driver_name() const override;

    /// Gives the device up because of this error; again: nothing more.
    void give_up(const DeviceError& error);
    /// What computes from then on; nullptr while the device is good.
    Backend* successor() const { return cpu_.get(); }

  private:
    std::unique_ptr<Backend> own_;
    Backend& device_;
    std::unique_ptr<Backend> cpu_;
    std::optional<LastingSearchDevice> search_;
    Log& log_;
};

/// The session that computes for this one: on the device or on the CPU, if it is one of a LastingBackend;
/// itself otherwise. One that failed is kept as long as `session`, since others may be drawing from it.
const DeformSession& computing(const DeformSession& session);

} // namespace anvil
