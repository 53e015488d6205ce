// StudySettings.h - what a study is allowed to do and how (study.json). One table of fields reads, writes and checks
// study.json (studyFields()); `study create --set KEY=VALUE` and the window's form use the same table.
//
// Thread-safety: values; the tables are constant.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/RecordFields.h"
#include "core/base/Units.h"
#include "core/base/Words.h"
#include "core/calibration/CalibrationStore.h"
#include "core/calibration/LoadSafetyStore.h"

namespace tacto {

enum class StudyKind { Study, Rehearsal };
enum class Modality { Electrodes, Massager };
inline constexpr Word<Modality> kModalities[] = {{"electrodes", Modality::Electrodes},
                                                 {"massager", Modality::Massager}};
/// Where electrodes may be placed. The list is closed: chest, neck and head cannot be chosen.
enum class ElectrodeSite { Forearm, ResidualLimbEnd, UpperArm, Hand };
enum class Nerve { Radial, Median, Ulnar };
enum class Limb { Left, Right };
/// How the detection threshold is measured (pilot.md section 4); the words are those of the protocols' `method`.
enum class DetectionMethod { Quest, Staircase };
inline constexpr Word<DetectionMethod> kDetectionMethods[] = {{"quest", DetectionMethod::Quest},
                                                              {"staircase", DetectionMethod::Staircase}};
/// What happens to a participant's data if they ask for destruction.
enum class DataOnRequest { Destroy, Keep };

[[nodiscard]] std::string_view nameOf(StudyKind kind) noexcept;
[[nodiscard]] constexpr std::string_view nameOf(Modality modality) noexcept { return wordFor(kModalities, modality); }
[[nodiscard]] std::string_view nameOf(ElectrodeSite site) noexcept;
[[nodiscard]] std::string_view nameOf(DetectionMethod method) noexcept;
[[nodiscard]] std::string_view nameOf(DataOnRequest kept) noexcept;

/// A committee's approval. Days are UTC days; the first and the last day are included.
struct Approval {
    std::string reference;
    std::string committee;
    CalibrationDate from{};
    CalibrationDate expires{};
    std::string protocolVersion;
    std::string protocolSha256;  ///< protocolHash() of the approved settings
    bool operator==(const Approval&) const = default;
};

/// A protocol's script and the hash of its bytes.
struct ScriptHash {
    std::string name;  ///< "pilot-identification"
    std::string sha256;
    bool operator==(const ScriptHash&) const = default;
};

/// Words that the participant may read (core/pilot/ParticipantWords.h).
struct WordsHash {
    std::string code;  ///< the language: "de"
    std::string version;
    std::string sha256;
    bool operator==(const WordsHash&) const = default;
};
/// Returns "de, version 1 (0123456789ab…)".
[[nodiscard]] std::string nameOf(const WordsHash& words);

struct StudyElectrode {
    std::string type = "self-adhesive";
    SquareCentimetres area{4};
    double distance_mm = 40;  ///< centre to centre
    bool operator==(const StudyElectrode&) const = default;
};

/// The only kind of train that a study delivers (H6).
/// The only pulse shape that is used with people.
inline constexpr std::string_view kBiphasic = "biphasic";

struct StudyTrain {
    std::string shape{kBiphasic};
    double width_us = 200;  ///< width of one phase
    double gap_us = 50;
    int pulses = 1;
    double rate_hz = 0;  ///< pulse rate within a train; 0 if there is only one pulse
    bool operator==(const StudyTrain&) const = default;
};

/// The approved stimuli and questions for people, apart from electrode and train. A session's profile and protocol must
/// agree with them.
struct StudyProcedure {
    double intervalMin_s = 0.5;  ///< T_min
    double intervalMax_s = 2;    ///< T_max
    DetectionMethod method = DetectionMethod::Quest;
    std::string conditionsSha256{};  ///< hash of conditions, assignment, polarity, load range and ceilings
    bool comparison = false;         ///< sessions also measure the Weber fraction of strength
    bool operator==(const StudyProcedure&) const = default;
};

inline constexpr int kPainCeiling = 4;
inline constexpr int kAgeMin = 18;  ///< of a new study, unless its approval says otherwise

struct StudySettings {
    std::string id;  ///< 16 hexadecimal digits; set by Study::create()
    std::string title;
    StudyKind kind = StudyKind::Study;
    Modality modality = Modality::Electrodes;
    Approval approval;
    std::string consentVersion;
    int participantsMax = 5;
    int sessionsMax = 4;  ///< for each participant
    /// Lowest age in years; earlier studies do not say one.
    std::optional<int> ageMin;
    double gapMin_h = 20;
    double sessionMax_min = 60;
    double cap_mA = 15;
    std::vector<LimitSetHash> limits;  ///< the limit sets of the approval
    ElectrodeSite site = ElectrodeSite::UpperArm;
    Nerve nerve = Nerve::Median;
    Limb limb = Limb::Right;
    StudyElectrode electrode;
    StudyTrain train;
    std::string conditions =
        "texture-pressure";  ///< the four of texture × pressure; no plain text contains their names
    std::vector<std::string> encodings{"standard"};
    int blocks = 5;
    int perCondition = 4;
    int catchTrials = 2;  ///< per block
    bool blind = true;
    DataOnRequest dataOnRequest = DataOnRequest::Destroy;
    /// A pain rating (0 to 10) this high holds the next presentation (pilot.md section 4). Approvals of earlier studies
    /// have no ceiling, and kPainCeiling applies.
    std::optional<int> painCeiling;
    std::vector<std::string> exclusions;      ///< the laboratory's own questions of the exclusion checklist
    std::string license;                      ///< the licence of exported data, such as "CC-BY-4.0"; empty: not decided
    std::vector<ScriptHash> scripts;          ///< the approved scripts; a session's script must be one of them
    std::vector<WordsHash> words;             ///< approved; older studies state none until they are amended
    std::optional<StudyProcedure> procedure;  ///< approved; older studies have none until they are amended
    bool operator==(const StudySettings&) const = default;
};

/// The fields of study.json.
[[nodiscard]] const RecordFields<StudySettings>& studyFields();

/// Sets one field by its key, as in `--set blocks=3` or `--set electrode.area_cm2=5`.
/// Errors: InvalidArgument naming key, value and what is accepted; also for id, kind, approval, scripts and the parts
/// of the procedure that a profile states, which have options of their own.
[[nodiscard]] Result<void> setStudyField(StudySettings& settings, std::string_view key, std::string_view value);

/// Returns the hash for an approval's protocol_sha256: SHA-256 of the scripts and all settings except the approval
/// itself and the licence of exports. A missing procedure is left out,
/// and so are words that are not stated.
[[nodiscard]] std::string protocolHash(const StudySettings& settings);
/// Returns the hash of settings and procedure of a session: an interrupted session resumes only with the same hash.
[[nodiscard]] std::string runHash(StudySettings settings, const StudyProcedure& procedure);

// What an approval says about the procedure, in words for reports and terminals.

struct ProcedureFact {
    std::string what;   ///< for example "Train"
    std::string words;  ///< for example "biphasic, 1 pulse of 200 µs a phase"
};
/// Returns site, electrodes and train (not with a massager), intervals, conditions, detection and test, as approved. If
/// the approval contains no procedure, a note replaces intervals, conditions and detection.
[[nodiscard]] std::vector<ProcedureFact> approvedProcedure(const StudySettings& settings);

/// Returns the words for a key of study.json that an amendment changed. Returns the key itself if it has no words, or
/// if it is about current and the study uses a massager.
[[nodiscard]] std::string amendedWords(std::string_view key, Modality modality);

}  // namespace tacto
