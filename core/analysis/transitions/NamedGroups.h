// NamedGroups.h - rows gathered by their names, in the order in which the names first come.
//
// Thread-safety: pure functions.
#pragma once

#include <string>
#include <vector>

namespace tacto {

/// The group of that name, made where there is none yet. `Group` has a `name`.
template <class Group>
[[nodiscard]] Group& groupNamed(std::vector<Group>& groups, const std::string& name) {
    for (auto& group : groups) {
        if (group.name == name) return group;
    }
    groups.emplace_back().name = name;
    return groups.back();
}

/// Empty groups of these names, so that a name without rows is missed.
template <class Group>
[[nodiscard]] std::vector<Group> groupsOf(const std::vector<std::string>& names) {
    std::vector<Group> groups;
    for (const auto& name : names) static_cast<void>(groupNamed(groups, name));
    return groups;
}

}  // namespace tacto
