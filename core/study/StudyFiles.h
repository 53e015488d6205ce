// StudyFiles.h - the files in a study's folder: where they lie, how the folder is created and locked, and how
// study.json is read and replaced.
//
// Thread-safety: pure functions except for the file access.
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
    /// The file with a rehearsal's keys.
    [[nodiscard]] std::filesystem::path keys() const { return folder / "rehearsal-keys.json"; }
};

/// Returns the text of study.json.
[[nodiscard]] std::string studyText(const StudySettings& settings);
/// Errors: Unsupported for a file of a newer version; ParseError naming `source`.
[[nodiscard]] Result<StudySettings> parseStudy(std::string_view text, const std::string& source);
/// Writes `text` as a draft next to study.json (its name with ".new" added), so that it survives power loss.
[[nodiscard]] Result<void> draftStudy(const StudyFiles& files, std::string_view text);
/// Replaces study.json with the draft. Errors: Io.
[[nodiscard]] Result<void> publishStudy(const StudyFiles& files);
/// Reads study.json; if the draft has the hash `sha256` (the program was killed before publishing), reads the draft.
[[nodiscard]] Result<std::string> readStudy(const StudyFiles& files, std::string_view sha256);

/// Whether `path` lies in `folder` once all links are followed.
[[nodiscard]] bool liesInside(const std::filesystem::path& path, const std::filesystem::path& folder);

// One program at a time changes a study.
//
// Both the folder and a file in it are locked: someone may remove the file as a left-over, and some file systems cannot
// lock folders. A file next to the study's keys is locked too, since copies of a study share its keys. Nothing is
// written about the owner of a lock: a program that changes nothing leaves the folder unchanged.

/// A lock held as long as this object exists.
class StudyLock {
public:
    /// Errors: Io naming the program that holds the lock, or saying that the lock cannot be taken.
    /// `besideKeys` is empty for a rehearsal, whose keys lie in its folder.
    [[nodiscard]] static Result<StudyLock> take(const StudyFiles& files, const std::filesystem::path& besideKeys);
    StudyLock(StudyLock&& other) noexcept
        : folder_(std::exchange(other.folder_, -1)), file_(std::move(other.file_)), keys_(std::move(other.keys_)) {}
    StudyLock& operator=(StudyLock&&) = delete;
    ~StudyLock() {
        if (folder_ >= 0) ::close(folder_);  // closing also releases the lock
    }

private:
    StudyLock(int folder, LockedFile file, std::optional<LockedFile> keys) noexcept
        : folder_(folder), file_(std::move(file)), keys_(std::move(keys)) {}
    int folder_;
    LockedFile file_;
    std::optional<LockedFile> keys_;
};

// Creates the folder and the key file of a study.

/// Returns the path of the file with the keys of a study.
[[nodiscard]] std::filesystem::path keyFileOf(const StudyFiles& files, const StudySettings& settings,
                                              const Study::Surroundings& around);
/// Errors: Unsupported if the key folder lies inside the study's folder.
[[nodiscard]] Result<void> keysLieOutside(const StudyFiles& files, const Study::Surroundings& around);

/// Returns `settings` for a rehearsal: sets empty fields, and allows as many participants as are wanted.
[[nodiscard]] StudySettings asRehearsal(StudySettings settings, CalibrationDate today);

/// Returns the body of the ledger's rows "study" and "amendment"; `text` is the text of study.json.
[[nodiscard]] nlohmann::json settingsRow(const StudySettings& settings, std::string_view text);

/// Creates the study under another name first, so that a crash leaves no study or a complete one. `passphrase` is null
/// for a rehearsal. Errors: Unsupported for a folder that is not empty; Io.
[[nodiscard]] Result<void> makeStudy(const StudyFiles& files, const StudySettings& settings,
                                     const Passphrase* passphrase, const Study::Surroundings& around);

}  // namespace tacto
