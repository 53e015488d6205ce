// CaptureFormats.h - the formats that a program knows, in the order in which they are tried on a file.
//
// Thread-safety: call add() before sharing the list; afterwards any threads may use it at once.
#pragma once

#include <memory>
#include <vector>

#include "core/formats/CaptureFormat.h"

namespace tacto {

class CaptureFormats {
public:
    /// Adds a format at the end of the list. Formats that recognise fewer files must be added first.
    void add(std::unique_ptr<CaptureFormat> format);

    [[nodiscard]] const std::vector<std::unique_ptr<CaptureFormat>>& all() const noexcept { return formats_; }
    /// Returns every suffix once, with the dot, in lower case.
    [[nodiscard]] std::vector<std::string_view> suffixes() const;
    [[nodiscard]] std::vector<std::string_view> writableSuffixes() const;
    /// Returns whether a format has the file's suffix; case is ignored. The content is not read.
    [[nodiscard]] bool knowsSuffix(const std::filesystem::path& path) const;

    /// Returns the format named in the options, or the first that recognises the file. Errors: NotFound, Io;
    /// InvalidArgument for an unknown id; ParseError if no format recognises the file. The last two list the known
    /// formats.
    [[nodiscard]] Result<const CaptureFormat*> formatOf(const std::filesystem::path& path,
                                                        const ReadOptions& options) const;

    /// Recognises the format and reads the file. Errors: those of formatOf() and of the format's read(); Io if the
    /// samples do not fit into memory.
    [[nodiscard]] Result<CaptureReading> read(const std::filesystem::path& path, const ReadOptions& options = {},
                                              const ReadWatch& watch = {}) const;

    /// Returns the format that writes files with this suffix. Errors: InvalidArgument listing those that exist.
    [[nodiscard]] Result<const CaptureFormat*> writerOf(const std::filesystem::path& path) const;

    /// Writes in the format for the file's suffix. Errors: those of writerOf() and of the format's write().
    [[nodiscard]] Result<void> write(const std::filesystem::path& path, const Capture& capture) const;

private:
    std::vector<std::unique_ptr<CaptureFormat>> formats_;
};

/// Adds the formats of core/formats: CSV dialects, Tektronix ISF, WAV. Plain CSV is last: it accepts any table.
void addOwnFormats(CaptureFormats& formats);

/// Returns a list with only these formats.
[[nodiscard]] std::shared_ptr<const CaptureFormats> ownCaptureFormats();

}  // namespace tacto
