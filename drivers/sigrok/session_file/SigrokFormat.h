// SigrokFormat.h - sigrok session files (.sr), as PulseView and sigrok-cli save them, read and written by libsigrok.
//
// Logic channels become 0 and 1 without a unit, analog channels volts, the only unit of the file format. A channel in
// amperes is therefore written with " (A)" after its name and recognised by that when read. Sampling rates are whole
// hertz; the start time and the trigger are not saved.
//
// Thread-safety: as CaptureFormat.
#pragma once

#include "core/formats/CaptureFormat.h"

namespace tacto {

class SigrokFormat final : public CaptureFormat {
public:
    std::string_view id() const noexcept override { return "sr"; }
    std::string_view name() const noexcept override { return "sigrok session"; }
    std::vector<std::string_view> suffixes() const override { return {".sr"}; }
    bool recognises(const std::filesystem::path& path, std::string_view head) const override;
    Result<CaptureReading> read(const std::filesystem::path& path, const ReadOptions& options,
                                const ReadWatch& watch) const override;
    bool canWrite() const noexcept override { return true; }
    /// Errors: as checkWritable(); InvalidArgument for a rate that is not a whole number of Hz (relative tolerance
    /// 1e-6); Io with libsigrok's message. An existing file is replaced only once everything is written.
    Result<void> write(const std::filesystem::path& path, const Capture& capture) const override;
};

}  // namespace tacto
