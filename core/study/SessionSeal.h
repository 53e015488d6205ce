// SessionSeal.h - seals the rows of one file of a study: each is bound to study, file, row number and kind.
//
// Thread-safety: as RowSeal.
#pragma once

#include <string>

#include "core/seal/Secret.h"
#include "core/session/RowSeal.h"

namespace tacto {

class SessionSeal final : public RowSeal {
public:
    /// `file`: the name of a session's file without its ending, or "ledger".
    SessionSeal(std::string study, std::string file, Secret key);

    [[nodiscard]] std::string sealText(std::int64_t seq, std::string_view kind, std::string_view text) const override;
    [[nodiscard]] Result<std::string> openText(std::int64_t seq, std::string_view kind,
                                               std::string_view sealed) const override;
    [[nodiscard]] std::vector<std::byte> sealBytes(std::int64_t seq, std::string_view kind,
                                                   std::span<const std::span<const std::byte>> parts) const override;
    [[nodiscard]] Result<std::vector<std::byte>> openBytes(std::int64_t seq, std::string_view kind,
                                                           std::span<const std::byte> sealed) const override;

private:
    [[nodiscard]] std::string place(std::int64_t seq, std::string_view kind) const;

    const std::string study_;
    const std::string file_;
    const Secret key_;
};

}  // namespace tacto
