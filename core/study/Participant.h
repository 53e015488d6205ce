// Participant.h - one person of a study, or one virtual participant. Never a name, a birth date or a hospital number.
//
// A code ends in a check character (ISO 7064 mod 37,36 over its letters and digits), so that a mistyped code is not
// another participant's.
//
// Thread-safety: values; newCode() draws from the system's random numbers.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Words.h"
#include "core/calibration/CalibrationStore.h"

namespace tacto {

enum class ParticipantGroup { Intact, LimbDifference };
inline constexpr Word<ParticipantGroup> kParticipantGroups[] = {{"intact", ParticipantGroup::Intact},
                                                                {"limb difference", ParticipantGroup::LimbDifference}};
enum class ParticipantState { Active, Left, Withdrawn };
inline constexpr Word<ParticipantState> kParticipantStates[] = {
    {"active", ParticipantState::Active}, {"left", ParticipantState::Left}, {"withdrawn", ParticipantState::Withdrawn}};

struct Consent {
    std::string version;
    CalibrationDate date{};
    std::string by;  ///< initials of who took it
    bool operator==(const Consent&) const = default;
};

/// The words of BIDS.
inline constexpr std::string_view kSexes[] = {"female", "male", "other"};
inline constexpr std::string_view kHandednesses[] = {"right", "left", "ambidextrous"};

struct Participant {
    std::string id;    ///< 16 random hexadecimal digits; stands in the ledger
    std::string code;  ///< "P-7K3D"; empty without the study's key, and once withdrawn
    ParticipantGroup group = ParticipantGroup::Intact;
    std::optional<std::uint64_t> virtualSeed;  ///< a virtual participant's
    std::string age, sex, handedness;          ///< only where the approval asks for them, in whole years; else empty
    std::vector<Consent> consents;
    ParticipantState state = ParticipantState::Active;
    int sessions = 0;          ///< begun
    int enrolled = 0;          ///< 1, 2, ... in the order of enrolment: what an order of encodings goes by
    bool virtualGone = false;  ///< a virtual participant's who withdrew: the seed is gone
    bool readable = true;      ///< false: all but id, state, sessions and enrolled is sealed and there is no key
    bool operator==(const Participant&) const = default;
    [[nodiscard]] bool isVirtual() const noexcept { return virtualSeed.has_value() || virtualGone; }
};

/// The beginning of a virtual participant's name before there is a code: "virtual:SEED".
inline constexpr std::string_view kVirtualPrefix = "virtual:";
[[nodiscard]] std::string virtualName(std::uint64_t seed);

/// Age, sex and handedness may each be left out. Errors: InvalidArgument for an age that is not a whole number from 1
/// to 120 and for other words than kSexes and kHandednesses.
[[nodiscard]] Result<void> checkAbout(const Participant& participant);

/// The code in its stored form: upper case, with its hyphens.
/// Errors: NotFound for a text that is not a code or whose check character is wrong, naming what is accepted.
[[nodiscard]] Result<std::string> checkedCode(std::string_view text);
/// A new code, "P-" and four characters, the last of which checks.
[[nodiscard]] std::string newCode();
/// The check character of letters and digits (upper case). Nothing for another character.
[[nodiscard]] std::optional<char> checkCharacter(std::string_view lettersAndDigits) noexcept;

// The people and devices on which the figures of a session rest. It is noted when the session begins, and every count,
// figure, name and sentence made of the session says it; figures of one kind are never counted with another's.

enum class SessionBasis {
    Person,           ///< a person answered what real devices gave
    PersonSimulated,  ///< a person answered, as in a rehearsal; the devices were simulated, and nothing was felt
    Virtual,          ///< a virtual participant on simulated devices
};
inline constexpr Word<SessionBasis> kSessionBases[] = {{"person", SessionBasis::Person},
                                                       {"person on simulated devices", SessionBasis::PersonSimulated},
                                                       {"virtual participant", SessionBasis::Virtual}};
[[nodiscard]] constexpr std::string_view nameOf(SessionBasis basis) noexcept {
    return wordFor(Words<SessionBasis>(kSessionBases), basis);
}

[[nodiscard]] constexpr bool isSimulatedBasis(SessionBasis basis) noexcept { return basis != SessionBasis::Person; }

/// "P-7K3D", "P-7K3D (simulated devices)", "P-7K3D (virtual)".
[[nodiscard]] std::string namedWith(SessionBasis basis, std::string_view name);
/// "people", "people on simulated devices", "virtual participants"; of one "person", ...
[[nodiscard]] std::string_view peopleOf(SessionBasis basis, std::size_t n = 2) noexcept;
/// "3 people and 12 virtual participants"; "0 people" where there are none.
[[nodiscard]] std::string countsText(const std::map<SessionBasis, std::size_t>& counts);

/// The basis of a pilot protocol's results: their member `participant` tells it.
[[nodiscard]] SessionBasis basisIn(const nlohmann::json& results);

}  // namespace tacto
