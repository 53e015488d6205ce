// StudyLog.h - what a study notes beside its sessions, as standards of reporting ask: particulars of the study, people
// who were assessed and not enrolled, use and deficiencies of the device, deviations from the plan.
//
// Each kind of note and its fields are described here once; the window's dialogs, `study note`, reports and exports
// follow. A field that was left empty is *unknown*. Notes are sealed in the ledger under the study's key. Notes never
// name a person.
//
// Sources: CONSORT 2010 extension for pilot trials (Eldridge 2016, items 2, 4b, 4c, 6a, 6c, 7, 13, 14, 23 to 25); RATES
// (2025, 10.1038/s41596-025-01259-0: participants, stimulator, electrodes, procedure); ISO 14155:2020 (device
// accountability, device deficiencies, deviations); names of exported fields: BIDS, and the draft NIBS-BIDS (BEP037,
// electric stimulation).
//
// Thread-safety: values; pure functions.
#pragma once

#include <chrono>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

struct StudyLogField {
    enum class Is { Text, Date, Words };
    const char* key;
    const char* label;
    const char* tip = "";
    Is is = Is::Text;
    std::vector<const char*> words = {};  ///< the accepted words, besides an empty value
    bool needed = false;                  ///< an empty value is refused
    const char* exported = nullptr;       ///< name in the sidecars of an export; null: not exported there
};

struct StudyLogKind {
    const char* key;      ///< "deviation", in commands and rows
    const char* title;    ///< "A deviation from the plan", of one note
    const char* heading;  ///< "Deviations from the plan", of all
    const char* explains;
    bool lastCounts;  ///< the notes are one record: a later note replaces fields of earlier ones
    std::vector<StudyLogField> fields;

    [[nodiscard]] const StudyLogField* field(std::string_view fieldKey) const noexcept;
};

/// Keys of the kinds that reports and exports name.
inline constexpr const char* kParticulars = "particulars";
inline constexpr const char* kAssessed = "assessed";

[[nodiscard]] const std::vector<StudyLogKind>& studyLogKinds();
/// Errors: InvalidArgument naming the kinds.
[[nodiscard]] Result<const StudyLogKind*> studyLogKind(std::string_view key);

struct StudyNote {
    std::string kind;
    std::chrono::sys_seconds at{};
    std::map<std::string, std::string> said;  ///< the text of each field; empty or missing: unknown

    /// Returns the text of a field, or "unknown".
    [[nodiscard]] std::string text(std::string_view field) const;
};

/// Errors: InvalidArgument naming the kind or field, its value and what is accepted.
[[nodiscard]] Result<void> checkNote(const StudyNote& note);
/// Returns the study's particulars: for each field, its last text. All fields are unknown if there is no note.
[[nodiscard]] StudyNote particularsOf(std::span<const StudyNote> notes);

[[nodiscard]] nlohmann::json toJson(const StudyNote& note);
/// Reads the fields; unknown fields are of a newer program and are kept. Errors: ParseError.
[[nodiscard]] Result<std::map<std::string, std::string>> noteTextsFrom(const nlohmann::json& json);

}  // namespace tacto
