// IsfFormat.h - Tektronix ISF: the oscilloscope's answer to WAVFrm?, stored in a file with one channel.
//
// The file has a preamble of `KEY value` pairs separated by ';', in long (YMULT) or short spelling (YMU). Then come
// `:CURVE ` and a block `#<digits><bytes><samples>`, or comma-separated numbers if the encoding is ASCII.
//   value = (code - YOFF) * YMULT + YZERO, at XZERO + (i - PT_OFF) * XINCR
// XZERO and PT_OFF are 0 where they are missing; YMULT, YOFF and YZERO must be there.
// Source: the WFMOutpre and CURVe commands in Tektronix' programmer manuals; checked against a MDO4104C's own CSV.
// Envelopes (PT_FMT ENV: two values per interval) and FFTs (XUNIT other than s) are refused.
//
// Thread-safety: as CaptureFormat.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/Result.h"
#include "core/formats/CaptureFormat.h"

namespace tacto {

class IsfFormat final : public CaptureFormat {
public:
    std::string_view id() const noexcept override { return "isf"; }
    std::string_view name() const noexcept override { return "Tektronix ISF"; }
    std::vector<std::string_view> suffixes() const override { return {".isf"}; }
    bool recognises(const std::filesystem::path& path, std::string_view head) const override;
    /// The input range is the range of the codes: a sample at either end of it is clipped.
    Result<CaptureReading> read(const std::filesystem::path& path, const ReadOptions& options,
                                const ReadWatch& watch) const override;
};

// The keys of a Tektronix waveform preamble, which describe the samples that follow.

struct IsfPreamble {
    std::size_t curve = 0;   ///< position of the first byte after ":CURVE "
    std::size_t points = 0;  ///< number of samples (NR_PT)
    unsigned bytes = 1;      ///< bytes per sample: 1 or 2
    bool text = false;       ///< true: samples are numbers as text
    bool isSigned = true;
    bool mostFirst = true;  ///< true: most significant byte first
    double interval_s = 0;
    double start_s = 0;  ///< time of sample 0
    double scale = 1;    ///< value of one code, in the channel's unit
    double offset = 0;   ///< code that stands for zero
    double zero = 0;
    std::string unit;   ///< unit as the file spells it: "V"
    std::string title;  ///< "Ch1, DC coupling, …"

    [[nodiscard]] double valueOf(double code) const noexcept { return (code - offset) * scale + zero; }
};

/// Returns whether `head` looks like the beginning of an ISF file.
[[nodiscard]] bool isIsf(std::string_view head);

/// Reads the preamble. Errors: ParseError naming file, key, value and what was expected.
[[nodiscard]] Result<IsfPreamble> readIsfPreamble(std::string_view head, std::string_view file);

}  // namespace tacto
