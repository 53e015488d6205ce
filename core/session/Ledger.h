// Ledger.h - a session file that is never finished: programs add rows to it for years.
//
// Rows are events on the hash chain of a session file; their time is UTC in whole seconds since 1970. Read a ledger
// with SessionReader and check it with verifySession().
//
// Promise (hazard H8): once append() has returned a value, the row survives kill -9 and power loss.
//
// Thread-safety: one caller at a time in one program only; the owner of the ledger holds a lock (core/study/Study.h).
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
    /// Creates the file with `about` as row 1. Errors: InvalidArgument if the file exists; Io.
    [[nodiscard]] static Result<Ledger> create(const std::filesystem::path& path, const SessionAbout& about,
                                               std::chrono::sys_seconds now);
    /// Opens the file to add rows after its last row. Errors: NotFound; ParseError for a damaged file; Io.
    [[nodiscard]] static Result<Ledger> open(const std::filesystem::path& path);
    Ledger(Ledger&&) noexcept;
    Ledger& operator=(Ledger&&) noexcept;
    ~Ledger();

    /// Returns the row's number. Errors: Io; after an Io error every later call fails too.
    [[nodiscard]] Result<std::int64_t> append(std::chrono::sys_seconds now, std::string_view name,
                                              const nlohmann::json& body);
    /// The number that the next row will get; the seals in that row are bound to this number.
    [[nodiscard]] std::int64_t next() const noexcept;
    /// Hash of the last row: 64 hexadecimal digits.
    [[nodiscard]] std::string head() const;

private:
    struct State;
    explicit Ledger(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tacto
