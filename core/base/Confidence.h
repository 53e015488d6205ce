// Confidence.h - how sure we are that a figure of a standard or a data sheet is what it says.
//
// Thread-safety: constants.
#pragma once

#include "core/base/Words.h"

namespace tacto {

enum class Confidence { High, Medium, MediumLow, Low };

inline constexpr Word<Confidence> kConfidences[] = {{"high", Confidence::High},
                                                    {"medium", Confidence::Medium},
                                                    {"medium-low", Confidence::MediumLow},
                                                    {"low", Confidence::Low}};
[[nodiscard]] constexpr std::string_view nameOf(Confidence confidence) noexcept {
    return wordFor(kConfidences, confidence);
}

}  // namespace tacto
