#include "core/session/SessionTypes.h"

#include <limits>

#include "core/base/RecordFields.h"

namespace tacto {

namespace {

using nlohmann::json;

constexpr AcceptedText kAnyText{.mayBeEmpty = true};
constexpr std::size_t kAnyNumber = std::numeric_limits<std::size_t>::max();
const RecordPlace kRow{.lenient = true};  // missing members stay empty

ValueKind<Instant> instantKind() {
    return codedKind<Instant>(
        "seconds",
        [](const json& value) -> std::optional<Instant> {
            const double at = value.is_number() ? value.get<double>() : -1;
            return at >= 0 && at < 1e9 ? std::optional(toInstant(at)) : std::nullopt;
        },
        [](const Instant& at) { return json(toSeconds(at)); });
}

ValueKind<json> anyKind() {
    return codedKind<json>(
        "any value", [](const json& value) { return std::optional(value); }, [](const json& value) { return value; });
}

RecordFields<SessionAbout> buildAboutFields() {
    using D = SessionDevice;
    RecordFields<D> device;
    device.texts({{"uri", &D::uri},
                  {"role", &D::role},
                  {"name", &D::name},
                  {"serial", &D::serial},
                  {"firmware", &D::firmware},
                  {"origin", &D::origin}},
                 kAnyText);
    device.flag("simulated", &D::simulated);

    using L = SessionLimitSet;
    RecordFields<L> limits;
    limits.texts({{"id", &L::id}, {"sha256", &L::sha256}, {"from", &L::from}}, kAnyText);

    using A = SessionAbout;
    RecordFields<A> all;
    all.texts({{"program_version", &A::programVersion},
               {"protocol", &A::protocol},
               {"protocol_sha256", &A::protocolSha256},
               {"protocol_from", &A::protocolFrom},
               {"profile", &A::profileJson},
               {"profile_sha256", &A::profileSha256},
               {"mode", &A::mode},
               {"wall_start", &A::wallStart}},
              kAnyText);
    all.add("parameters", &A::parameters, anyKind());
    all.number("seed", &A::seed);
    all.list("devices", &A::devices, device.kind(), 0, kAnyNumber);
    all.list("limit_sets", &A::limitSets, limits.kind(), 0, kAnyNumber);
    all.flag("simulated", &A::simulated);
    all.flag("virtual_clock", &A::virtualClock);
    all.add("wall_start_at_s", &A::wallStartAt, instantKind());
    return all;
}

const RecordFields<SessionAbout>& aboutFields() { return builtOnce<buildAboutFields>(); }

RecordFields<SessionStream> buildStreamFields() {
    using S = SessionStream;
    RecordFields<S> all;
    all.texts({{"name", &S::name}, {"kind", &S::kind}, {"unit", &S::unit}}, kAnyText);
    all.list("columns", &S::columns, textKind(kAnyText), 0, kAnyNumber);
    all.number("rate_hz", &S::rate_hz);
    return all;
}

const RecordFields<SessionStream>& streamFields() { return builtOnce<buildStreamFields>(); }

}  // namespace

json toJson(const SessionAbout& about) { return aboutFields().write(about); }

SessionAbout aboutFrom(const json& row) { return aboutFields().read(row, kRow).value_or(SessionAbout{}); }

json reproducible(const SessionAbout& about) {
    auto out = toJson(about);
    for (const char* key : {"program_version", "wall_start", "wall_start_at_s"}) out.erase(key);
    out.erase("protocol_from");  // a path
    for (auto& set : out["limit_sets"]) set.erase("from");
    for (auto& device : out["devices"]) {
        device.erase("uri");  // a path if the device is a recording
        device.erase("firmware");
    }
    return out;
}

json toJson(const SessionStream& stream) { return streamFields().write(stream); }

SessionStream streamFrom(const json& row) {
    SessionStream stream;
    stream.rate_hz = std::numeric_limits<double>::quiet_NaN();  // not known, for a damaged row; 0 would mean no rate
    static_cast<void>(streamFields().read(row, stream, kRow));
    return stream;
}

}  // namespace tacto
