// UriParameters.h - reads a device URI's parameters, each exactly once, each checked against its range.
//
// The first thing wrong is kept and given by finish(), so that a device reads all of its parameters in a row; what was
// not asked for by then is unknown and refused with the list of what was.
//
// Thread-safety: none; one owner.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/Result.h"
#include "core/devices/DeviceUri.h"
#include "drivers/simulated/FaultSchedule.h"

namespace tacto::sim {

class UriParameters {
public:
    explicit UriParameters(const DeviceUri& uri) : uri_(uri) {}

    /// A number with an optional engineering prefix and `unit` ("500ohm", "2ms", "0.5"), from `low` to `high`.
    [[nodiscard]] double quantity(std::string_view key, std::string_view unit, double otherwise, double low,
                                  double high);
    /// A whole number from `low` to `high`.
    [[nodiscard]] int integer(std::string_view key, int otherwise, int low, int high);
    /// Any text, for the caller to judge.
    [[nodiscard]] std::optional<std::string> text(std::string_view key);
    [[nodiscard]] std::string choice(std::string_view key, std::string_view otherwise,
                                     std::initializer_list<std::string_view> accepted);
    /// All `fault=` parameters.
    [[nodiscard]] FaultSchedule faults(std::initializer_list<Fault> accepted);

    /// Notes a problem that the caller found with `key`.
    void refuse(std::string_view key, std::string_view value, std::string_view accepted);
    /// Errors: InvalidArgument naming the key, its value and what is accepted.
    [[nodiscard]] Result<void> finish() const;

private:
    [[nodiscard]] std::optional<std::string_view> take(std::string_view key);
    const DeviceUri& uri_;
    std::vector<std::string> known_;
    std::optional<Error> problem_;
};

}  // namespace tacto::sim
