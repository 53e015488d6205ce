// Participant.h - one person of a study, or one virtual participant. Never holds a name, birth date or hospital number.
//
// A code ends in a check character (ISO 7064 mod 37,36 over its letters and digits), so that a mistyped code does not
// match another participant's.
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
    std::string by;  ///< initials of the person who took the consent
    bool operator==(const Consent&) const = default;
};

/// The words that BIDS uses.
inline constexpr std::string_view kSexes[] = {"female", "male", "other"};
inline constexpr std::string_view kHandednesses[] = {"right", "left", "ambidextrous"};

struct Participant {
    std::string id;    ///< 16 random hexadecimal digits; appears in the ledger
    std::string code;  ///< such as "P-7K3D"; empty without the study's key, or after withdrawal
    ParticipantGroup group = ParticipantGroup::Intact;
    std::optional<std::uint64_t> virtualSeed;  ///< only for a virtual participant
    std::string age, sex, handedness;          ///< empty unless the approval asks for them; age in whole years
    std::vector<Consent> consents;
    ParticipantState state = ParticipantState::Active;
    std::string leftBecause;   ///< why they left; empty: not known
    int sessions = 0;          ///< number of sessions begun
    int enrolled = 0;          ///< place in the order of enrolment, from 1; decides the order of encodings
    bool virtualGone = false;  ///< a virtual participant who withdrew; the seed was deleted
    bool readable = true;      ///< false: without the key, only id, state, sessions and enrolled are known
    bool operator==(const Participant&) const = default;
    [[nodiscard]] bool isVirtual() const noexcept { return virtualSeed.has_value() || virtualGone; }
};

/// A virtual participant's name is "virtual:SEED" until there is a code; this is its beginning.
inline constexpr std::string_view kVirtualPrefix = "virtual:";
[[nodiscard]] std::string virtualName(std::uint64_t seed);

/// Age, sex and handedness may each be empty. Errors: InvalidArgument for an age that is not a whole number from 1 to
/// 120, and for words other than kSexes and kHandednesses.
[[nodiscard]] Result<void> checkAbout(const Participant& participant);

/// Returns the code in its stored form, in upper case and with hyphens.
/// Errors: NotFound, naming what is accepted, for a text that is not a code or has a wrong check character.
[[nodiscard]] Result<std::string> checkedCode(std::string_view text);
/// Draws a new code: "P-" and four characters, of which the last is the check character.
[[nodiscard]] std::string newCode();
/// Returns the check character of letters and digits (upper case), or nothing if there is any other character.
[[nodiscard]] std::optional<char> checkCharacter(std::string_view lettersAndDigits) noexcept;

// Who answered in a session, and whether the devices were real. This is recorded when the session begins, and every
// count, figure, name and sentence about the session states it; different kinds are never counted together.

enum class SessionBasis {
    Person,           ///< a person on real devices
    PersonSimulated,  ///< a person on simulated devices, as in a rehearsal; nothing was felt
    Virtual,          ///< a virtual participant on simulated devices
};
inline constexpr Word<SessionBasis> kSessionBases[] = {{"person", SessionBasis::Person},
                                                       {"person on simulated devices", SessionBasis::PersonSimulated},
                                                       {"virtual participant", SessionBasis::Virtual}};
[[nodiscard]] constexpr std::string_view nameOf(SessionBasis basis) noexcept {
    return wordFor(Words<SessionBasis>(kSessionBases), basis);
}

[[nodiscard]] constexpr bool isSimulatedBasis(SessionBasis basis) noexcept { return basis != SessionBasis::Person; }

/// Returns text such as "P-7K3D", "P-7K3D (simulated devices)" or "P-7K3D (virtual)".
[[nodiscard]] std::string namedWith(SessionBasis basis, std::string_view name);
/// Returns "people", "people on simulated devices" or "virtual participants"; the singular if `n` is 1.
[[nodiscard]] std::string_view peopleOf(SessionBasis basis, std::size_t n = 2) noexcept;
/// Returns text such as "3 people and 12 virtual participants", or "0 people" if all counts are 0.
[[nodiscard]] std::string countsText(const std::map<SessionBasis, std::size_t>& counts);

/// Returns the basis of a pilot protocol's results, from their member `participant`.
[[nodiscard]] SessionBasis basisIn(const nlohmann::json& results);

}  // namespace tacto
