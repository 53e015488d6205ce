// WavFormat.h - RIFF WAVE: recordings from sound interfaces, and captures for programs that know no other table.
//
// Read: PCM of 8 (unsigned), 16, 24 and 32 bits and floats of 32 and 64, plain or extensible, in RIFF, and in RF64 and
// BW64, which recorders write beyond 4 GB. PCM samples are fractions of the full scale, which no WAV states: --unit and
// --probe say what 1 stands for, else a warning does. Written by libsndfile: 32-bit floats in V and A as they are, with
// names, units and start in an INFO comment that other programs pass over; so a capture returns bit by bit.
//
// Thread-safety: as CaptureFormat.
#pragma once

#include "core/formats/CaptureFormat.h"

namespace tacto {

class WavFormat final : public CaptureFormat {
public:
    std::string_view id() const noexcept override { return "wav"; }
    std::string_view name() const noexcept override { return "WAV"; }
    std::vector<std::string_view> suffixes() const override { return {".wav"}; }
    bool recognises(const std::filesystem::path& path, std::string_view head) const override;
    Result<CaptureReading> read(const std::filesystem::path& path, const ReadOptions& options,
                                const ReadWatch& watch) const override;
    bool canWrite() const noexcept override { return true; }
    /// Errors: those of checkWritable(); InvalidArgument for a rate that is not a whole number of Hz (to a millionth of
    /// itself), more than 1024 channels or more than 4.2 GB; Io.
    Result<void> write(const std::filesystem::path& path, const Capture& capture) const override;
};

}  // namespace tacto
