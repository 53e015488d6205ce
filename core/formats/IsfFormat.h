// IsfFormat.h - Tektronix ISF: what the oscilloscope answers to WAVFrm?, in a file. One channel per file.
//
// A preamble of `KEY value` pairs with ';' between them, in long (YMULT) or short spelling (YMU), then `:CURVE ` and a
// block `#<digits><bytes><samples>`, or numbers with commas between them where the encoding is ASCII.
//   value = (code - YOFF) * YMULT + YZERO, at XZERO + (i - PT_OFF) * XINCR
// XZERO and PT_OFF are 0 where they are missing; YMULT, YOFF and YZERO must be there.
// Source: the WFMOutpre and CURVe commands in Tektronix' programmer manuals; checked against a MDO4104C's own CSV.
// Envelopes (PT_FMT ENV: two values per interval) and FFTs (XUNIT other than s) are refused.
//
// Thread-safety: as CaptureFormat.
#pragma once

#include "core/formats/CaptureFormat.h"

namespace tacto {

class IsfFormat final : public CaptureFormat {
public:
    std::string_view id() const noexcept override { return "isf"; }
    std::string_view name() const noexcept override { return "Tektronix ISF"; }
    std::vector<std::string_view> suffixes() const override { return {".isf"}; }
    bool recognises(const std::filesystem::path& path, std::string_view head) const override;
    /// The input range is that of the codes: a sample at either end of them is clipped.
    Result<CaptureReading> read(const std::filesystem::path& path, const ReadOptions& options,
                                const ReadWatch& watch) const override;
};

}  // namespace tacto
