#include "core/session/Ledger.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/JsonText.h"
#include "core/session/Schema.h"
#include "core/session/SessionStore.h"
#include "core/session/SessionTypes.h"

namespace tacto {

namespace {

Instant ledgerTime(std::chrono::sys_seconds now) noexcept { return now.time_since_epoch(); }

}  // namespace

struct Ledger::State {
    State(std::filesystem::path where, SessionStore opened) : path(std::move(where)), store(std::move(opened)) {}
    std::filesystem::path path;
    SessionStore store;
    std::optional<Error> failed;
};

Ledger::Ledger(std::unique_ptr<State> state) : state_(std::move(state)) {}
Ledger::Ledger(Ledger&&) noexcept = default;
Ledger& Ledger::operator=(Ledger&&) noexcept = default;
Ledger::~Ledger() {
    if (state_) static_cast<void>(state_->store.close());
}

Result<Ledger> Ledger::create(const std::filesystem::path& path, const SessionAbout& about,
                              std::chrono::sys_seconds now) {
    auto store = SessionStore::create(path, ledgerTime(now), dumpJson(toJson(about)), kSchemaVersion);
    if (!store) return failure(store);
    return Ledger(std::make_unique<State>(path, std::move(*store)));
}

Result<Ledger> Ledger::open(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) return fail(ErrorCode::NotFound, "there is no file {}", path.string());
    auto store = SessionStore::continued(path);
    if (!store)
        return fail(store.error().code, "{} cannot be opened for writing: {}", path.string(), store.error().message);
    return Ledger(std::make_unique<State>(path, std::move(*store)));
}

Result<std::int64_t> Ledger::append(std::chrono::sys_seconds now, std::string_view name, const nlohmann::json& body) {
    if (state_->failed) return tl::unexpected<Error>(*state_->failed);
    auto row = state_->store.addNow(kind::kEvent, ledgerTime(now), name, dumpJson(body));
    if (row) return row;
    state_->failed =
        Error{ErrorCode::Io, fmt::format("{} cannot be written: {}", state_->path.string(), row.error().message)};
    state_->store.abandon();
    return tl::unexpected<Error>(*state_->failed);
}

std::int64_t Ledger::next() const noexcept { return state_->store.rows() + 1; }
std::string Ledger::head() const { return hexText(state_->store.head()); }

}  // namespace tacto
