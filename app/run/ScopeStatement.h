// ScopeStatement.h - what else is stated of the oscilloscope that is open: by its calibration certificate.
//
// A certificate counts for its serial number alone and from its date until it is due. Captures of a folder (`capture:`)
// have none: it is not known which instrument took them, and when. A serial number of a simulated oscilloscope
// (SIM-...) counts for a simulated one only. An unused certificate says why (hazard H9).
//
// Thread-safety: pure but for reading the store; keepCertificate() as SessionWriter.
#pragma once

#include <optional>
#include <string>

#include "core/calibration/CertificateStore.h"
#include "core/devices/DeviceSet.h"
#include "core/session/SessionWriter.h"

namespace tacto {

struct KnownCertificate {
    InstrumentStatement statement;  ///< empty unless used
    bool used = false;
    std::string text;                          ///< one sentence; empty where this oscilloscope can have no certificate
    std::optional<Certificate> certificate{};  ///< the certificate in use
};
/// How the certificate of that device stands today.
[[nodiscard]] KnownCertificate knownCertificate(const DeviceIdentity& oscilloscope);

/// Adds to what `devices` state of their oscilloscope; what comes last wins, figure by figure: the address, the
/// certificate. Returns the certificate as knownCertificate().
KnownCertificate stateOscilloscope(DeviceSet& devices);

/// Writes it for the session's report; nothing where no certificate can be of this oscilloscope. Errors: as
/// SessionWriter::event().
[[nodiscard]] Result<void> keepCertificate(const KnownCertificate& known, SessionWriter& session, Instant at);

}  // namespace tacto
