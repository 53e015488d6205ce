// IsfPreamble.h - the keys of a Tektronix waveform preamble, and what they say about the samples behind it.
//
// Thread-safety: pure functions.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/Result.h"

namespace tacto {

struct IsfPreamble {
    std::size_t curve = 0;   ///< place of the first byte behind ":CURVE " in the text
    std::size_t points = 0;  ///< NR_PT
    unsigned bytes = 1;      ///< bytes in a sample: 1 or 2
    bool text = false;       ///< numbers as text
    bool isSigned = true;
    bool mostFirst = true;  ///< byte order
    double interval_s = 0;
    double start_s = 0;  ///< time of sample 0
    double scale = 1;    ///< value of one code
    double offset = 0;   ///< code that means zero
    double zero = 0;
    std::string unit;   ///< as written: "V"
    std::string title;  ///< "Ch1, DC coupling, …"

    [[nodiscard]] double valueOf(double code) const noexcept { return (code - offset) * scale + zero; }
};

/// Whether `head` begins like one.
[[nodiscard]] bool isIsf(std::string_view head);

/// Errors: ParseError naming file, key, its value and what was expected.
[[nodiscard]] Result<IsfPreamble> readIsfPreamble(std::string_view head, std::string_view file);

}  // namespace tacto
