#include "core/study/SessionBasis.h"

#include <fmt/ranges.h>
#include <vector>

#include "core/base/JsonText.h"

namespace tacto {

std::string namedWith(SessionBasis basis, std::string_view name) {
    constexpr std::string_view kAfter[] = {"", " (simulated devices)", " (virtual)"};
    return fmt::format("{}{}", name, kAfter[static_cast<std::size_t>(basis)]);
}

std::string_view peopleOf(SessionBasis basis, std::size_t n) noexcept {
    switch (basis) {
        case SessionBasis::Person:
            return n == 1 ? "person" : "people";
        case SessionBasis::PersonSimulated:
            return n == 1 ? "person on simulated devices" : "people on simulated devices";
        case SessionBasis::Virtual:
            break;
    }
    return n == 1 ? "virtual participant" : "virtual participants";
}

std::string countsText(const std::map<SessionBasis, std::size_t>& counts) {
    std::vector<std::string> all;
    for (const auto& [basis, n] : counts) {
        if (n > 0) all.push_back(fmt::format("{} {}", n, peopleOf(basis, n)));
    }
    return all.empty() ? "0 people" : fmt::format("{}", fmt::join(all, " and "));
}

SessionBasis basisIn(const nlohmann::json& results) {
    const auto participant = valueOr(results, "participant");
    if (const auto said = valueFor(kSessionBases, textOr(participant, "basis"))) return *said;
    return flagOr(participant, "virtual") ? SessionBasis::Virtual : SessionBasis::Person;
}

}  // namespace tacto
