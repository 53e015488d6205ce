// DccFile.h - a digital calibration certificate as a file: PTB's DCC, version 3, with quantities in D-SI
// (https://ptb.de/dcc, https://ptb.de/si). What a program needs of it, each value with its uncertainty.
//
// Such a file comes from elsewhere and is trusted in nothing: it is UTF-8 of at most kDccLimit bytes without document
// type (so without entities), of at most kDccMostQuantities quantities, its lists fit each other, its numbers are
// numbers, and a signature that does not fit is refused (hazards H9 and H10).
//
// Thread-safety: pure functions.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/exchange/dcc/DccSignature.h"

namespace tacto {

inline constexpr std::size_t kDccLimit = std::size_t{16} << 20;  ///< bytes
inline constexpr std::size_t kDccMostQuantities = 4096;

/// Texts are those in English, else without a language, else the first.
struct DccItem {
    std::string name, manufacturer, model, serial;  ///< empty: not stated
    std::string id{};                               ///< by which results refer to it; empty: not stated
};

/// A value, or a list of them. NaN: absent, as D-SI writes it.
struct DccQuantity {
    std::vector<std::string> refTypes{};
    std::string name{};
    std::string within{};  ///< names of the result and the lists that it stands in, from outside
    std::size_t list = 0;  ///< quantities of the same list belong together, value by value
    /// Of DccFile::items: to which it refers itself, or else what it stands in; empty: not stated.
    std::vector<std::size_t> items{};
    std::string unit{};  ///< of D-SI, "\milli\volt"
    std::vector<double> values{};
    /// Expanded uncertainty in `unit` and its coverage factor for each value; empty: not stated. A standard uncertainty
    /// has the factor 1.
    std::vector<double> uncertainties{}, coverageFactors{};
    std::vector<double> probabilities{};  ///< of coverage; empty for a standard uncertainty
    std::string distribution{};           ///< empty: not stated
    [[nodiscard]] bool is(std::string_view refType) const;
};

struct DccFile {
    std::string schemaVersion;  ///< "3.3.0"
    std::string number;         ///< its unique identifier
    std::string laboratory;
    std::string begun, ended, issued;         ///< days as 2026-11-21; the last may be empty
    std::vector<std::string> recalibrations;  ///< days on which it is due, as many as are stated
    std::vector<DccItem> items;               ///< at least one
    std::vector<DccQuantity> quantities;
    bool simulated = false;  ///< it is one of ours, and says that nothing was measured on hardware
    DccSignature signature;
};

/// Errors: NotFound; Io; ParseError, one sentence that names the file and what is wrong with it.
[[nodiscard]] Result<DccFile> readDcc(const std::filesystem::path& path);
/// The same for the bytes of a file; `name` begins every message.
[[nodiscard]] Result<DccFile> dccFrom(std::string_view bytes, std::string_view name);
/// A text of a file for a message: printable, cut after 60 bytes.
[[nodiscard]] std::string shownOf(std::string_view text);

}  // namespace tacto
