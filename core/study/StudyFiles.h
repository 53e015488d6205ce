// StudyFiles.h - where the parts of a study lie in its folder, and how study.json is read and replaced.
//
// Thread-safety: pure but for the files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/Result.h"
#include "core/study/StudySettings.h"

namespace tacto {

struct StudyFiles {
    std::filesystem::path folder;

    [[nodiscard]] std::filesystem::path settings() const { return folder / "study.json"; }
    [[nodiscard]] std::filesystem::path ledger() const { return folder / "ledger.tacto"; }
    [[nodiscard]] std::filesystem::path lock() const { return folder / "study.lock"; }
    [[nodiscard]] std::filesystem::path sessions() const { return folder / "sessions"; }
    [[nodiscard]] std::filesystem::path session(std::string_view file) const;
    /// A rehearsal's keys.
    [[nodiscard]] std::filesystem::path keys() const { return folder / "rehearsal-keys.json"; }
};

/// The text of study.json.
[[nodiscard]] std::string studyText(const StudySettings& settings);
/// Errors: Unsupported for one of a newer version; ParseError naming `source`.
[[nodiscard]] Result<StudySettings> parseStudy(std::string_view text, const std::string& source);
/// Writes `text` whole, so that it survives power loss, under the name of study.json with ".new" behind it.
[[nodiscard]] Result<void> draftStudy(const StudyFiles& files, std::string_view text);
/// The draft takes its place. Errors: Io.
[[nodiscard]] Result<void> publishStudy(const StudyFiles& files);
/// The text of study.json, or of its draft where that has `sha256`: a program was killed between the two.
[[nodiscard]] Result<std::string> readStudy(const StudyFiles& files, std::string_view sha256);

/// Whether `path` lies in `folder`, whatever links lead there.
[[nodiscard]] bool liesInside(const std::filesystem::path& path, const std::filesystem::path& folder);

}  // namespace tacto
