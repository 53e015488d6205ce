// DeviceUri.h - how a device is named on a command line: scheme:path?key=value&key=value
//
//   sim:                                                  every role that is still needed, simulated
//   sim:stimulator?mode=current&gain=1.02&fault=open@12s  one simulated device and its flaws
//   recording:../data/mat1_1                              a recording replayed as a fingertip
//
// Thread-safety: values; pure functions.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

struct DeviceUri {
    std::string scheme;
    std::string path;
    std::vector<std::pair<std::string, std::string>> parameters;  ///< in the order written; keys may repeat

    /// Errors: InvalidArgument for a text without "scheme:" or a parameter without "=".
    [[nodiscard]] static Result<DeviceUri> parse(std::string_view text);
    [[nodiscard]] std::string text() const;

    /// Builds the error arm of a Result, as fail(), for what is wrong with this device: it is named in front.
    template <class... Args>
    [[nodiscard]] tl::unexpected<Error> refuse(ErrorCode code, fmt::format_string<Args...> format,
                                               Args&&... args) const {
        return fail(code, "device \"{}\": {}", text(), fmt::format(format, std::forward<Args>(args)...));
    }
    /// The same of an error that does not name the device.
    [[nodiscard]] tl::unexpected<Error> refuse(const Error& error) const {
        return refuse(error.code, "{}", error.message);
    }
    /// For one that means several devices: lists what it could be.
    [[nodiscard]] tl::unexpected<Error> refuseChoice(const std::vector<std::string>& addresses) const;
};

/// A unit by name, whichever of its outputs is used: its driver and its serial number ("sciencemode 1234"); without one
/// the whole of `uri`.
[[nodiscard]] std::string unitOf(std::string_view serial, std::string_view uri);

/// What a calibration counts for: one output of one unit. The serial number, followed by the channel and connector
/// that `uri` chooses ("PP-7 channel=2"). Empty without a serial number: what cannot be told apart is not
/// calibrated.
[[nodiscard]] std::string calibratedOutput(std::string_view serial, std::string_view uri);

}  // namespace tacto
