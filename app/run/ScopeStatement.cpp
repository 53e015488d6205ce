#include "app/run/ScopeStatement.h"

#include <fmt/format.h>

#include "core/calibration/CertificateStore.h"

namespace tacto {

KnownCertificate knownCertificate(const DeviceIdentity& oscilloscope) {
    if (oscilloscope.uri.starts_with("capture:")) return {};
    const auto store = CertificateStore::open(certificateFile());
    if (!store) return {{}, false, fmt::format("no certificate is used: {}", store.error().message)};
    if (store->all().empty()) return {};
    if (oscilloscope.serial.empty()) {
        return {{}, false, "the oscilloscope reports no serial number: no certificate is used for it"};
    }
    const auto today = utcToday();
    const auto found = store->newest(oscilloscope.serial, today);
    if (!found) return {};
    const auto& certificate = store->all()[*found].certificate;
    const auto named = fmt::format("{} of the oscilloscope {}", certificateText(certificate), oscilloscope.serial);
    if (certificate.serial.starts_with("SIM-") && !oscilloscope.simulated) {
        return {{}, false, fmt::format("{} is of a simulated one: its figures are not used", named)};
    }
    const auto state = store->state(*found, today);
    if (state != CertificateState::Counts) {
        return {{}, false, fmt::format("{} is {}: its figures are not used", named, nameOf(state))};
    }
    return {statementOf(certificate), true, fmt::format("{} is used, {}", named, figuresText(certificate)),
            certificate};
}

KnownCertificate stateOscilloscope(DeviceSet& devices) {
    if (!devices.oscilloscope) return {};
    auto certificate = knownCertificate(devices.oscilloscope->identity());
    devices.scopeStatement = merged(devices.scopeStatement, certificate.statement);
    return certificate;
}

Result<void> keepCertificate(const KnownCertificate& known, SessionWriter& session, Instant at) {
    if (known.text.empty()) return {};
    nlohmann::json event = {{"text", known.text}, {"used", known.used}};
    if (known.certificate) event["certificate"] = toJson(*known.certificate);
    const auto kept = session.event(at, kCertificateEvent, event);
    if (!kept) return failure(kept);
    return {};
}

}  // namespace tacto
