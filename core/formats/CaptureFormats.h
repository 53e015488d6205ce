// CaptureFormats.h - the formats that a program knows, in the order in which they are asked whether a file is theirs.
//
// Thread-safety: add() before it is shared; afterwards any threads at once.
#pragma once

#include <memory>
#include <vector>

#include "core/formats/CaptureFormat.h"

namespace tacto {

class CaptureFormats {
public:
    /// Behind those already there: the format that recognises more narrowly comes first.
    void add(std::unique_ptr<CaptureFormat> format);

    [[nodiscard]] const std::vector<std::unique_ptr<CaptureFormat>>& all() const noexcept { return formats_; }
    /// Every suffix once, with the dot, in lower case.
    [[nodiscard]] std::vector<std::string_view> suffixes() const;
    [[nodiscard]] std::vector<std::string_view> writableSuffixes() const;
    /// Whether the file's suffix is one of ours; capitals ignored. The content is not looked at.
    [[nodiscard]] bool knowsSuffix(const std::filesystem::path& path) const;

    /// The format that options name, else the first that recognises the file.
    /// Errors: NotFound, Io; InvalidArgument for an unknown id; ParseError when no format recognises it. Both list what
    /// is known.
    [[nodiscard]] Result<const CaptureFormat*> formatOf(const std::filesystem::path& path,
                                                        const ReadOptions& options) const;

    /// Recognises and reads. Errors: of formatOf() and of the format's read(); Io where the samples do not fit into
    /// memory.
    [[nodiscard]] Result<CaptureReading> read(const std::filesystem::path& path, const ReadOptions& options = {},
                                              const ReadWatch& watch = {}) const;

    /// The format that writes files of this suffix. Errors: InvalidArgument listing the suffixes that are written.
    [[nodiscard]] Result<const CaptureFormat*> writerOf(const std::filesystem::path& path) const;

    /// Writes in the format of the suffix. Errors: those of writerOf() and of the format's write().
    [[nodiscard]] Result<void> write(const std::filesystem::path& path, const Capture& capture) const;

private:
    std::vector<std::unique_ptr<CaptureFormat>> formats_;
};

/// The formats of core/formats: the CSV dialects, Tektronix ISF, WAV. Plain CSV is the last: it takes any table.
void addOwnFormats(CaptureFormats& formats);

/// A list of those alone.
[[nodiscard]] std::shared_ptr<const CaptureFormats> ownCaptureFormats();

}  // namespace tacto
