// StudyFiles.h - where the parts of a study lie in its folder, how it is made and locked, how study.json is read and
// replaced.
//
// Thread-safety: pure but for the files.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <unistd.h>
#include <utility>

#include "core/base/Result.h"
#include "core/safety/LockedFile.h"
#include "core/study/Study.h"
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

// One program at a time changes a study.
//
// Both the folder and a file in it are held: the file may be removed by someone who takes it for a left-over, and not
// every file system holds folders. A file beside the study's keys is held too: copies of a study share its keys.
// Nothing is written to say who holds it: a program that changes nothing leaves the folder as it was.

/// Held as long as the value lives.
class StudyLock {
public:
    /// Errors: Io naming the program that holds it, or that the lock cannot be taken.
    /// `besideKeys` is empty for a rehearsal, whose keys lie in its folder.
    [[nodiscard]] static Result<StudyLock> take(const StudyFiles& files, const std::filesystem::path& besideKeys);
    StudyLock(StudyLock&& other) noexcept
        : folder_(std::exchange(other.folder_, -1)), file_(std::move(other.file_)), keys_(std::move(other.keys_)) {}
    StudyLock& operator=(StudyLock&&) = delete;
    ~StudyLock() {
        if (folder_ >= 0) ::close(folder_);  // closing releases the lock, too
    }

private:
    StudyLock(int folder, LockedFile file, std::optional<LockedFile> keys) noexcept
        : folder_(folder), file_(std::move(file)), keys_(std::move(keys)) {}
    int folder_;
    LockedFile file_;
    std::optional<LockedFile> keys_;
};

// Makes the folder and the key file of a study.

/// The file with the keys of a study.
[[nodiscard]] std::filesystem::path keyFileOf(const StudyFiles& files, const StudySettings& settings,
                                              const Study::Surroundings& around);
/// Errors: Unsupported when the key folder lies inside the study's.
[[nodiscard]] Result<void> keysLieOutside(const StudyFiles& files, const Study::Surroundings& around);

/// `settings` for a rehearsal: empty fields are filled in, and it takes as many participants as are wanted.
[[nodiscard]] StudySettings asRehearsal(StudySettings settings, CalibrationDate today);

/// The body of the ledger's rows "study" and "amendment"; `text` is the text of study.json.
[[nodiscard]] nlohmann::json settingsRow(const StudySettings& settings, std::string_view text);

/// Makes the study under another name first, so that a crash leaves none or a whole one. `passphrase` is null for a
/// rehearsal. Errors: Unsupported for a folder that holds something; Io.
[[nodiscard]] Result<void> makeStudy(const StudyFiles& files, const StudySettings& settings,
                                     const Passphrase* passphrase, const Study::Surroundings& around);

}  // namespace tacto
