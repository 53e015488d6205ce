// DeviceUri.h - the address of a device on a command line: scheme:path?key=value&key=value
//
//   sim:                                                  simulates every role that is still needed
//   sim:stimulator?mode=current&gain=1.02&fault=open@12s  one simulated device with its flaws
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

    /// Builds the error of a Result, as fail() does; the message begins with the device's address.
    template <class... Args>
    [[nodiscard]] tl::unexpected<Error> refuse(ErrorCode code, fmt::format_string<Args...> format,
                                               Args&&... args) const {
        return fail(code, "device \"{}\": {}", text(), fmt::format(format, std::forward<Args>(args)...));
    }
    /// Refuses this device with an error whose message does not name it.
    [[nodiscard]] tl::unexpected<Error> refuse(const Error& error) const {
        return refuse(error.code, "{}", error.message);
    }
    /// Refuses an address that fits several devices: the message lists their addresses.
    [[nodiscard]] tl::unexpected<Error> refuseChoice(const std::vector<std::string>& addresses) const;
};

/// Returns the name of a unit, the same for all its outputs: driver and serial number ("sciencemode 1234"); without a
/// serial number, the whole `uri`.
[[nodiscard]] std::string unitOf(std::string_view serial, std::string_view uri);

/// Returns the name of the one output of one unit that a calibration covers: the serial number, then the channel and
/// connector that `uri` chooses ("PP-7 channel=2"). Empty without a serial number, because such units cannot be told
/// apart.
[[nodiscard]] std::string calibratedOutput(std::string_view serial, std::string_view uri);

// Reads the parameters of a device URI: each exactly once, and each checked against its range.
//
// finish() returns the first fault, so that a driver can read all its parameters in a row. A parameter not read by then
// is unknown; finish() refuses it and lists the known ones.

class UriParameters {
public:
    /// `uri` must outlive this object.
    explicit UriParameters(const DeviceUri& uri) : uri_(uri) {}

    /// Reads a number with an optional engineering prefix and `unit` ("500ohm", "2ms", "0.5"), from `low` to `high`.
    [[nodiscard]] std::optional<double> quantity(std::string_view key, std::string_view unit, double low, double high);
    [[nodiscard]] double quantity(std::string_view key, std::string_view unit, double otherwise, double low,
                                  double high) {
        return quantity(key, unit, low, high).value_or(otherwise);
    }
    /// Reads a whole number from `low` to `high`.
    [[nodiscard]] std::optional<int> integer(std::string_view key, int low, int high);
    [[nodiscard]] int integer(std::string_view key, int otherwise, int low, int high) {
        return integer(key, low, high).value_or(otherwise);
    }
    /// Reads any text; the caller checks it.
    [[nodiscard]] std::optional<std::string> text(std::string_view key);
    [[nodiscard]] std::string choice(std::string_view key, std::string_view otherwise,
                                     std::initializer_list<std::string_view> accepted);
    /// Returns the values of a key that may be given several times.
    [[nodiscard]] std::vector<std::string_view> each(std::string_view key);

    /// Notes a fault that the caller found in `key`.
    void refuse(std::string_view key, std::string_view value, std::string_view accepted);
    /// Notes a fault in the caller's own words.
    void refuse(std::string_view sentence);
    /// Errors: InvalidArgument naming the key, its value and what is accepted.
    [[nodiscard]] Result<void> finish() const;

private:
    [[nodiscard]] std::optional<std::string_view> take(std::string_view key);
    const DeviceUri& uri_;
    std::vector<std::string_view> known_;
    std::optional<Error> problem_;
};

// The keys of a device's address that state the accuracy of its oscilloscope.
//
//   sigrok:rigol-ds:conn=...?shunt=100ohm&gain_pct=2&probe_pct=1&shunt_pct=0.1&timebase_ppm=50
//   capture:FOLDER?gain_pct=2&probe_pct=0&shunt_pct=0.1&timebase_ppm=50
//
// gain_pct (both channels, of the reading), fs_pct (of full scale, as some data sheets state the gain), offset_v,
// offset_a, probe_pct (0: a plain cable), shunt_pct, timebase_ppm, stamp_s (time stamps of separate records relative to
// each other), lsb_v and lsb_a (one step, for files that do not state it).

/// True if `key` states an accuracy.
[[nodiscard]] bool statesAccuracy(std::string_view key) noexcept;

/// Takes the accuracy keys out of `uri`; returns nothing if it has none. Errors: InvalidArgument naming the key, its
/// value and what is accepted, or a key that is given twice.
[[nodiscard]] Result<std::optional<InstrumentStatement>> takeStatement(DeviceUri& uri);

}  // namespace tacto
