// SigrokOscilloscope.h - an oscilloscope that is driven through libsigrok.
//
// A thread of its own drives the instrument (SigrokThread.h). The bench waits only in arm(), until the instrument waits
// for triggers (about 0.1 s, at most 6 s); poll() returns finished records. poll() also reports any error that occurred
// in between; such an error is final, and the device has to be opened again. Silence of some seconds where data must
// come is a Timeout.
//
// Time stamps are the host's arrival times, because libsigrok passes on no trigger time. Times within a record come
// from the instrument; the record as a whole is stamped late by the time that reading it out takes (about 0.1 s).
//
// Thread-safety: as Oscilloscope. Destruction takes at most 2 s; if the instrument keeps libsigrok busy for longer, its
// thread is left running.
#pragma once

#include <memory>

#include "core/base/Clock.h"
#include "core/devices/Driver.h"
#include "core/devices/Oscilloscope.h"
#include "drivers/sigrok/protocol/ScopeUri.h"

namespace tacto::sigrok_driver {

/// Opens the instrument that `uri` names, within 12 s. `itself` is the URI for the identity.
/// Errors: InvalidArgument, NotFound, Device, Timeout, Io.
[[nodiscard]] Result<std::unique_ptr<Oscilloscope>> openOscilloscope(const ScopeUri& uri, const std::string& itself,
                                                                     const Clock& clock);

}  // namespace tacto::sigrok_driver
