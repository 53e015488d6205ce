// NewStudy.h - makes the folder and the key file of a study.
//
// Thread-safety: one caller at a time for a folder.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "core/base/Result.h"
#include "core/study/Study.h"
#include "core/study/StudyFiles.h"

namespace tacto {

/// Where the keys of a study lie.
[[nodiscard]] std::filesystem::path keyFileOf(const StudyFiles& files, const StudySettings& settings,
                                              const Study::Surroundings& around);
/// Errors: Unsupported when the key folder lies inside the study's.
[[nodiscard]] Result<void> keysLieOutside(const StudyFiles& files, const Study::Surroundings& around);

/// `settings` as those of a rehearsal: what is empty is filled in, and it takes as many participants as are wanted.
[[nodiscard]] StudySettings asRehearsal(StudySettings settings, CalibrationDate today);

/// The body of the ledger's rows "study" and "amendment"; `text` is that of study.json.
[[nodiscard]] nlohmann::json settingsRow(const StudySettings& settings, std::string_view text);

/// Makes the study under another name first, so that a crash leaves none or a whole one. `passphrase` is null for a
/// rehearsal. Errors: Unsupported for a folder that holds something; Io.
[[nodiscard]] Result<void> makeStudy(const StudyFiles& files, const StudySettings& settings,
                                     const Passphrase* passphrase, const Study::Surroundings& around);

}  // namespace tacto
