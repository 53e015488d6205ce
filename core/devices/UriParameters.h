// UriParameters.h - reads a device URI's parameters, each exactly once, each checked against its range.
//
// The first thing wrong is kept and given by finish(), so that a driver reads all of its parameters in a row; what was
// not asked for by then is unknown and refused with the list of what was.
//
// Thread-safety: none; one owner.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/devices/DeviceUri.h"

namespace tacto {

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
    /// Any text, for the caller to judge.
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

}  // namespace tacto
