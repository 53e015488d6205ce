// ShippedResources.h - the files of resources/ that are built into the program: the limit sets, the instrument
// profiles, the default profile and the digests of the shipped protocols. No file and no environment variable replaces
// them, so none can lower the safety floor (hazard H1) or change the accuracy stated for an oscilloscope (hazard H9).
//
// Thread-safety: constant.
#pragma once

#include <span>
#include <string_view>

namespace tacto {

struct ShippedLimitText {
    std::string_view file;  ///< "paper.json"
    std::string_view text;
};
/// The limits in the order of their names.
[[nodiscard]] std::span<const ShippedLimitText> shippedLimitTexts() noexcept;

struct ShippedInstrumentText {
    std::string_view file;  ///< "rigol-ds2000.json"
    std::string_view text;
};
/// The instruments in the order of their names.
[[nodiscard]] std::span<const ShippedInstrumentText> shippedInstrumentTexts() noexcept;

/// resources/encodings/default.json.
[[nodiscard]] std::string_view shippedProfileText() noexcept;

struct ShippedProtocol {
    std::string_view name;    ///< "separability"
    std::string_view sha256;  ///< of the script's bytes, in hexadecimal digits
};
[[nodiscard]] std::span<const ShippedProtocol> shippedProtocols() noexcept;

}  // namespace tacto
