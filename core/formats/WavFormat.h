// WavFormat.h - RIFF WAVE: recordings of sound interfaces, and captures for programs that read no other format.
//
// Reads PCM of 8 (unsigned), 16, 24 and 32 bits and floats of 32 and 64 bits, plain or extensible, in RIFF, and in RF64
// and BW64, which recorders write beyond 4 GB. PCM samples are fractions of full scale, which WAV does not state:
// --unit and --probe state it, else there is a warning. Writes 32-bit floats in V and A with libsndfile. Names, units
// and start are in an INFO comment that other programs ignore; a capture reads back bit by bit.
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
    /// Writes a capture. Errors: those of checkWritable(); InvalidArgument for a rate that is not a whole number of Hz
    /// (to a millionth), more than 1024 channels or more than 4.2 GB; Io.
    Result<void> write(const std::filesystem::path& path, const Capture& capture) const override;
};

}  // namespace tacto
