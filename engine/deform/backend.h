// A back end is an object that opens sessions; a session keeps an edit's data where it is computed.
#pragma once

#include "engine/deform/deform_input.h"

#include <memory>
#include <string>
#include <vector>

namespace anvil {

/// One edit, prepared. Calls from one thread at a time.
class DeformSession {
  public:
    virtual ~DeformSession() = default;

    /// Moves the points; returns when the work is submitted, the result stays where it was computed.
    /// @throws InternalError on sizes that do not fit the input, DeviceError.
    virtual void update(const DeformMotion& motion) = 0;

    /// Returns when the last update is done, without reading it back. @throws DeviceError.
    virtual void wait() = 0;

    /// The last update's result, one entry per point. @throws DeviceError, InternalError before an update.
    virtual std::vector<PointResult> download() = 0;

    /// The last update's normals, one for each run of the input's fans: unit, or zero where no triangle has
    /// area. @throws as download().
    virtual std::vector<Vec3> download_normals() = 0;

    /// Takes up again what has been changed in the input since it was prepared or last refreshed: shape
    /// functions (`segments` and `shapes`, for as many handles), or `occluders` and `start_distances`; points
    /// and fields stay. The next update uses it. @throws DeviceError, InternalError on sizes that do not fit.
    virtual void refresh_shapes() = 0;
    virtual void refresh_occluders() = 0;
};

class Backend {
  public:
    virtual ~Backend() = default;

    /// The session reads the input during its calls; between them its owner may change it as refresh_shapes()
    /// and refresh_occluders() say. @throws DeviceError if the device cannot hold the input.
    virtual std::unique_ptr<DeformSession> prepare(std::shared_ptr<const DeformInput> input) = 0;
    std::unique_ptr<DeformSession> prepare(DeformInput input) {
        return prepare(std::make_shared<const DeformInput>(std::move(input)));
    }
    /// Does beforehand what takes long before the first update of an edit like this one, whatever its points
    /// and fields: compiles kernels. From any thread, beside all other work. @throws DeviceError
    virtual void warm(const DeformInput& /*input*/, const DeformMotion& /*motion*/) {}
    /// What bakes distance fields faster than the CPU does; nullptr: nothing. As long as the back end is.
    virtual SearchDevice* search_device() { return nullptr; }
    virtual std::string device_name() const = 0;
    virtual std::string driver_name() const = 0;
};

/// The reference: double precision, the shared formulas, all cores.
std::unique_ptr<Backend> make_cpu_backend();

/// The shared formulas in float, as devices compute them, all cores; with AVX2 where `widest` and the
/// processor has it. A yardstick: at steps that differ in rounding it ends where a device ends, not where the
/// reference does.
std::unique_ptr<Backend> make_float_cpu_backend(bool widest = true);

} // namespace anvil
