// SigrokFormat.h - sigrok sessions (.sr), read and written by libsigrok: what PulseView and sigrok-cli save.
//
// Logic channels become 0 and 1 without a unit, analog ones volts: the file knows no other unit. So a channel in
// amperes is written with " (A)" behind its name, and read back by that. Sampling rates are whole hertz there; the
// start and the trigger are not kept.
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
    /// Errors: those of checkWritable(); InvalidArgument for a rate that is not a whole number of Hz (to a millionth of
    /// itself); Io with what libsigrok says. An existing file is replaced only once all is written.
    Result<void> write(const std::filesystem::path& path, const Capture& capture) const override;
};

}  // namespace tacto
