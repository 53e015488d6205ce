// ScopeStatement.h - what the calibration certificate of the open oscilloscope states.
//
// A certificate is valid only for its serial number, from its date until it is due. Captures from a folder (`capture:`)
// have none, because the instrument and time are not known. Certificates for simulated serial numbers (SIM-...) apply
// only to simulated oscilloscopes. For an unused certificate the reason is stated (hazard H9).
//
// Thread-safety: pure, except for reading the store; keepCertificate() as SessionWriter.
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
    std::string text;                          ///< one sentence; empty if this oscilloscope cannot have a certificate
    std::optional<Certificate> certificate{};  ///< the certificate in use
};
/// Returns the certificate of the oscilloscope and whether it is valid today.
[[nodiscard]] KnownCertificate knownCertificate(const DeviceIdentity& oscilloscope);

/// Adds the certificate's figures to those that `devices` states for the oscilloscope; they replace figures in the
/// address. Returns the certificate like knownCertificate().
KnownCertificate stateOscilloscope(DeviceSet& devices);

/// Writes the certificate for the session's report, unless this oscilloscope cannot have one. Errors: as
/// SessionWriter::event().
[[nodiscard]] Result<void> keepCertificate(const KnownCertificate& known, SessionWriter& session, Instant at);

}  // namespace tacto
