// Ledger.h - a session file that is never finished: one program after another adds rows to it, for years.
//
// Rows are events on the hash chain of a session file; their time is wall time, UTC, to the second, counted from 1970.
// Read it with SessionReader, look it over with verifySession().
//
// Promise (hazard H8): when append() returned a value, that row survives kill -9 and power loss.
//
// Thread-safety: one caller at a time, of one program: its owner holds a lock (core/study/Study.h).
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "core/base/Result.h"
#include "core/session/SessionTypes.h"

namespace tacto {

class Ledger {
public:
    /// Makes the file with `about` as row 1. Errors: InvalidArgument when it exists; Io.
    [[nodiscard]] static Result<Ledger> create(const std::filesystem::path& path, const SessionAbout& about,
                                               std::chrono::sys_seconds now);
    /// Continues after its last row. Errors: NotFound; ParseError for one that is damaged; Io.
    [[nodiscard]] static Result<Ledger> open(const std::filesystem::path& path);
    Ledger(Ledger&&) noexcept;
    Ledger& operator=(Ledger&&) noexcept;
    ~Ledger();

    /// The value is the row's number. Errors: Io; every later call fails too then.
    [[nodiscard]] Result<std::int64_t> append(std::chrono::sys_seconds now, std::string_view name,
                                              const nlohmann::json& body);
    /// The number that the next row gets: what its seals are bound to.
    [[nodiscard]] std::int64_t next() const noexcept;
    /// Hash of the last row, 64 hexadecimal digits.
    [[nodiscard]] std::string head() const;

private:
    struct State;
    explicit Ledger(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tacto
