// DeviceUri.h - how a device is named on a command line: scheme:path?key=value&key=value
//
//   sim:                                                  every role that is still needed, simulated
//   sim:stimulator?mode=current&gain=1.02&fault=open@12s  one simulated device and its flaws
//   recording:../data/mat1_1                              a recording replayed as a fingertip
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/Result.h"
#include "core/measure/InstrumentStatement.h"

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
    /// Refuses with an error that does not name the device.
    [[nodiscard]] tl::unexpected<Error> refuse(const Error& error) const {
        return refuse(error.code, "{}", error.message);
    }
    /// Refuses an address that means several devices: lists what it could be.
    [[nodiscard]] tl::unexpected<Error> refuseChoice(const std::vector<std::string>& addresses) const;
};

/// A unit by name, whichever of its outputs is used: its driver and its serial number ("sciencemode 1234"); without one
/// the whole of `uri`.
[[nodiscard]] std::string unitOf(std::string_view serial, std::string_view uri);

/// What a calibration counts for: one output of one unit. The serial number, followed by the channel and connector
/// that `uri` chooses ("PP-7 channel=2"). Empty without a serial number: what cannot be told apart is not
/// calibrated.
[[nodiscard]] std::string calibratedOutput(std::string_view serial, std::string_view uri);

// Reads a device URI's parameters, each exactly once, each checked against its range.
//
// The first fault is kept and given by finish(), so that a driver reads all of its parameters in a row; a parameter
// that nobody has asked for by then is unknown, and is refused with the list of known ones.

class UriParameters {
public:
    /// `uri` must outlive this.
    explicit UriParameters(const DeviceUri& uri) : uri_(uri) {}

    /// A number with an optional engineering prefix and `unit` ("500ohm", "2ms", "0.5"), from `low` to `high`.
    [[nodiscard]] std::optional<double> quantity(std::string_view key, std::string_view unit, double low, double high);
    [[nodiscard]] double quantity(std::string_view key, std::string_view unit, double otherwise, double low,
                                  double high) {
        return quantity(key, unit, low, high).value_or(otherwise);
    }
    /// A whole number from `low` to `high`.
    [[nodiscard]] std::optional<int> integer(std::string_view key, int low, int high);
    [[nodiscard]] int integer(std::string_view key, int otherwise, int low, int high) {
        return integer(key, low, high).value_or(otherwise);
    }
    /// Takes any text, for the caller to judge.
    [[nodiscard]] std::optional<std::string> text(std::string_view key);
    [[nodiscard]] std::string choice(std::string_view key, std::string_view otherwise,
                                     std::initializer_list<std::string_view> accepted);
    /// The values of a key that may be given several times.
    [[nodiscard]] std::vector<std::string_view> each(std::string_view key);

    /// Notes a problem that the caller found with `key`.
    void refuse(std::string_view key, std::string_view value, std::string_view accepted);
    /// Notes a problem in words of the caller's own.
    void refuse(std::string_view sentence);
    /// Errors: InvalidArgument naming the key, its value and what is accepted.
    [[nodiscard]] Result<void> finish() const;

private:
    [[nodiscard]] std::optional<std::string_view> take(std::string_view key);
    const DeviceUri& uri_;
    std::vector<std::string_view> known_;
    std::optional<Error> problem_;
};

// The keys of a device's address that state how accurate its oscilloscope is.
//
//   sigrok:rigol-ds:conn=...?shunt=100ohm&gain_pct=2&probe_pct=1&shunt_pct=0.1&timebase_ppm=50
//   capture:FOLDER?gain_pct=2&probe_pct=0&shunt_pct=0.1&timebase_ppm=50
//
// gain_pct (both channels, of the reading), fs_pct (of full scale: for data sheets that state the gain so), offset_v,
// offset_a, probe_pct (0: a plain cable), shunt_pct, timebase_ppm, stamp_s (of separate records against each other),
// lsb_v and lsb_a (one step, for files that do not say).

/// Whether `key` is one of those keys.
[[nodiscard]] bool statesAccuracy(std::string_view key) noexcept;

/// Takes those keys out of `uri`; nothing where it has none. Errors: InvalidArgument naming the key, its value and what
/// is accepted, or a key that stands twice.
[[nodiscard]] Result<std::optional<InstrumentStatement>> takeStatement(DeviceUri& uri);

}  // namespace tacto
