// UnitClaim.h - which record of a unit was the last one that a program drove it from, in a place that no account and no
// environment chooses (H1): a unit with two records, of two accounts or two data folders, has a past that neither
// knows.
//
// One small file per unit in a folder of the computer's that everybody may write to and that a start of the computer
// empties. It is locked while the claim lives, so two accounts never drive one unit at once. Where it cannot be kept,
// nothing is claimed, and the unit's past is not known. What drives a unit from another container or another computer
// is not seen.
//
// Thread-safety: none; the record's.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

#include "core/base/Result.h"

namespace tacto {

class UnitClaim {
public:
    /// Opens and locks the claim of `unit`, or makes it: `file` in `folder`. Null where none can be kept. Errors:
    /// Device when another process holds it, naming it.
    [[nodiscard]] static Result<std::unique_ptr<UnitClaim>> open(const std::filesystem::path& folder,
                                                                 std::string_view file, std::string_view unit);
    ~UnitClaim();
    UnitClaim(const UnitClaim&) = delete;
    UnitClaim& operator=(const UnitClaim&) = delete;

    /// True when the unit was driven from no other record than `record` since the computer started.
    [[nodiscard]] bool isOf(std::uint64_t record) const noexcept;
    /// True when the last program to drive the unit left it in a fault, or whether it did is unknown.
    [[nodiscard]] bool faulted() const noexcept;

    /// From here on the unit is driven from `record`.
    void take(std::uint64_t record, bool faulted) noexcept;
    void keepFault(bool faulted) noexcept;

private:
    struct State;
    explicit UnitClaim(std::unique_ptr<State> state);

    const std::unique_ptr<State> state_;
};

}  // namespace tacto
