// StudySettings.h - what a study is allowed to do and how it does it: study.json. One field table reads, writes and
// checks it (studyFields()), and `study create --set KEY=VALUE` and the window's form derive from the same.
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
/// Where electrodes may be put. A closed list: chest, neck and head cannot be chosen.
enum class ElectrodeSite { Forearm, ResidualLimbEnd, UpperArm, Hand };
enum class Nerve { Radial, Median, Ulnar };
enum class Limb { Left, Right };
/// How the detection threshold is sought (pilot.md section 4); the words are those of the protocols' `method`.
enum class DetectionMethod { Quest, Staircase };
inline constexpr Word<DetectionMethod> kDetectionMethods[] = {{"quest", DetectionMethod::Quest},
                                                              {"staircase", DetectionMethod::Staircase}};
/// The fate of a participant's data when they ask for destruction.
enum class DataOnRequest { Destroy, Keep };

[[nodiscard]] std::string_view nameOf(StudyKind kind) noexcept;
[[nodiscard]] constexpr std::string_view nameOf(Modality modality) noexcept { return wordFor(kModalities, modality); }
[[nodiscard]] std::string_view nameOf(ElectrodeSite site) noexcept;
[[nodiscard]] std::string_view nameOf(DetectionMethod method) noexcept;
[[nodiscard]] std::string_view nameOf(DataOnRequest kept) noexcept;

/// A committee's approval. Days are UTC days; both ends count.
struct Approval {
    std::string reference;
    std::string committee;
    CalibrationDate from{};
    CalibrationDate expires{};
    std::string protocolVersion;
    std::string protocolSha256;  ///< protocolHash() of what the committee approved
    bool operator==(const Approval&) const = default;
};

/// A protocol's script, as its bytes hash.
struct ScriptHash {
    std::string name;  ///< "pilot-identification"
    std::string sha256;
    bool operator==(const ScriptHash&) const = default;
};

struct StudyElectrode {
    std::string type = "self-adhesive";
    SquareCentimetres area{4};
    double distance_mm = 40;  ///< centre to centre
    bool operator==(const StudyElectrode&) const = default;
};

/// The one kind of train that a study delivers (H6).
/// The only shape of pulses that a person is given.
inline constexpr std::string_view kBiphasic = "biphasic";

struct StudyTrain {
    std::string shape{kBiphasic};
    double width_us = 200;  ///< one phase's width
    double gap_us = 50;
    int pulses = 1;
    double rate_hz = 0;  ///< pulses in a train; 0 with one pulse
    bool operator==(const StudyTrain&) const = default;
};

/// The stimuli and questions for people, beside electrode and train: an approval is for them, and a session's profile
/// and protocol must agree with them.
struct StudyProcedure {
    double intervalMin_s = 0.5;  ///< T_min
    double intervalMax_s = 2;    ///< T_max
    DetectionMethod method = DetectionMethod::Quest;
    std::string conditionsSha256{};  ///< hash of the conditions, their assignment, polarity, load range and ceilings
    bool comparison = false;         ///< sessions of thresholds measure the Weber fraction of strength too
    bool operator==(const StudyProcedure&) const = default;
};

inline constexpr int kPainCeiling = 4;

struct StudySettings {
    std::string id;  ///< 16 hexadecimal digits; made by Study::create()
    std::string title;
    StudyKind kind = StudyKind::Study;
    Modality modality = Modality::Electrodes;
    Approval approval;
    std::string consentVersion;
    int participantsMax = 5;
    int sessionsMax = 4;  ///< sessions that one participant may have
    double gapMin_h = 20;
    double sessionMax_min = 60;
    double cap_mA = 15;
    std::vector<LimitSetHash> limits;  ///< the approval's limits
    ElectrodeSite site = ElectrodeSite::UpperArm;
    Nerve nerve = Nerve::Median;
    Limb limb = Limb::Right;
    StudyElectrode electrode;
    StudyTrain train;
    std::string conditions =
        "texture-pressure";  ///< the four of texture × pressure; their names stand in no plain text
    std::vector<std::string> encodings{"standard"};
    int blocks = 5;
    int perCondition = 4;
    int catchTrials = 2;  ///< per block
    bool blind = true;
    DataOnRequest dataOnRequest = DataOnRequest::Destroy;
    /// A pain from 0 to 10 that is rated so high holds the next presentation (pilot.md section 4). Earlier studies have
    /// no ceiling in their approval, and are held to kPainCeiling.
    std::optional<int> painCeiling;
    std::string license;                      ///< the licence for using exports: "CC-BY-4.0"; empty: not decided
    std::vector<ScriptHash> scripts;          ///< approved; a session's script must be one of them
    std::optional<StudyProcedure> procedure;  ///< approved; older studies have none until they are amended
    bool operator==(const StudySettings&) const = default;
};

/// The fields of study.json.
[[nodiscard]] const RecordFields<StudySettings>& studyFields();

/// Sets one field by its key, as `--set blocks=3` or `--set electrode.area_cm2=5`.
/// Errors: InvalidArgument naming key, value and what is accepted; also for id, kind, approval, scripts and what a
/// profile says of the procedure, which have options of their own.
[[nodiscard]] Result<void> setStudyField(StudySettings& settings, std::string_view key, std::string_view value);

/// The hash in an approval's protocol_sha256: SHA-256 over every setting but the approval itself and the license of
/// exports, and the scripts. A missing procedure does not count.
[[nodiscard]] std::string protocolHash(const StudySettings& settings);
/// The hash of settings and what a session is run with: an interrupted session resumes with no other.
[[nodiscard]] std::string runHash(StudySettings settings, const StudyProcedure& procedure);

// What an approval covers of the procedure, in words, for people who read a report or a terminal.

struct ProcedureFact {
    std::string what;   ///< "Train"
    std::string words;  ///< "biphasic, 1 pulse of 200 µs a phase"
};
/// Site, electrodes and train (not with a massager), intervals, conditions, detection and test, as approved. Where the
/// approval keeps no procedure, that is said in the place of intervals, conditions and detection.
[[nodiscard]] std::vector<ProcedureFact> approvedProcedure(const StudySettings& settings);

/// The words for a key of study.json that an amendment changed; the key itself where it has no other name, and with a
/// massager where it is about current.
[[nodiscard]] std::string amendedWords(std::string_view key, Modality modality);

}  // namespace tacto
