#include "drivers/sciencemode/ScienceModeStimulator.h"

namespace tacto::sciencemode {

namespace {
constexpr int kOldestProtocol = 3;  // RehaMove3; nearly the same protocol
constexpr int kNewestProtocol = 4;  // P24
}  // namespace

Result<Identification> identify(Exchange& exchange, bool emulated) {
    const auto idPayload = exchange.ask(Command::DeviceId);
    if (!idPayload) return failure(idPayload);
    auto id = readDeviceIdAck(*idPayload);
    if (!id) return failure(id);
    if (id->id.empty()) return fail(ErrorCode::Device, "the stimulator has no identity; 10 characters were expected");
    if (emulated && !id->id.starts_with(kEmulatedId)) {
        return fail(ErrorCode::Device,
                    "stimulator {} answers where the address says emulated=yes; the identity of an emulated one begins "
                    "with {}",
                    id->id, kEmulatedId);
    }

    const auto versionPayload = exchange.ask(Command::ExtendedVersion);
    if (!versionPayload) return failure(versionPayload);
    const auto version = readExtendedVersionAck(*versionPayload);
    if (!version) return failure(version);
    if (version->protocol.major < kOldestProtocol || version->protocol.major > kNewestProtocol) {
        return fail(ErrorCode::Device, "stimulator {} speaks ScienceMode {}; version {} or {} was expected", id->id,
                    version->protocol.text(), kOldestProtocol, kNewestProtocol);
    }
    return Identification{std::move(id->id), version->firmware, version->protocol};
}

}  // namespace tacto::sciencemode
