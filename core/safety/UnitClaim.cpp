#include "core/safety/UnitClaim.h"

#include <fcntl.h>
#include <unistd.h>

#include "core/safety/LockedFile.h"

namespace tacto {

namespace {

constexpr std::uint64_t kClaimMagic = 0x31'6d'69'61'6c'63'74;  // "tclaim1"

struct Claim {
    std::uint64_t magic = kClaimMagic;
    std::uint64_t record = 0;
    std::uint64_t faulted = 0;
    std::int64_t process = 0;
};

}  // namespace

struct UnitClaim::State {
    explicit State(LockedFile&& opened) : file(std::move(opened)) {}
    [[nodiscard]] Checked<Claim>& claim() const noexcept { return *static_cast<Checked<Claim>*>(file.content()); }
    LockedFile file;
};

Result<std::unique_ptr<UnitClaim>> UnitClaim::open(const std::filesystem::path& folder, std::string_view file,
                                                   std::string_view unit) {
    const auto path = folder / file;
    auto opened = LockedFile::open(path, sizeof(Checked<Claim>), 0666);
    if (opened) return std::unique_ptr<UnitClaim>(new UnitClaim(std::make_unique<State>(std::move(*opened))));
    if (opened.error().why != LockedFile::Refusal::Held) return nullptr;
    Checked<Claim> claim;
    const int held = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    const bool known = held >= 0 && ::read(held, &claim, sizeof claim) == sizeof claim && claim.sound();
    if (held >= 0) ::close(held);
    return fail(ErrorCode::Device, "{} is driven by {}; end that first. Nothing was delivered here", unit,
                known ? programOf(claim.content.process) : "another process");
}

UnitClaim::UnitClaim(std::unique_ptr<State> state) : state_(std::move(state)) {}
UnitClaim::~UnitClaim() = default;

bool UnitClaim::isOf(std::uint64_t record) const noexcept {
    if (state_->file.made()) return true;
    const auto& claim = state_->claim();
    return claim.sound() && claim.content.magic == kClaimMagic && claim.content.record == record;
}

bool UnitClaim::faulted() const noexcept {
    if (state_->file.made()) return false;
    const auto& claim = state_->claim();
    return !claim.sound() || claim.content.magic != kClaimMagic || claim.content.faulted != 0;
}

void UnitClaim::take(std::uint64_t record, bool faulted) noexcept {
    state_->claim().write({.record = record, .faulted = faulted ? 1U : 0U, .process = ::getpid()});
}

void UnitClaim::keepFault(bool faulted) noexcept {
    auto newer = state_->claim().content;
    newer.faulted = faulted ? 1 : 0;
    state_->claim().write(newer);
}

}  // namespace tacto
