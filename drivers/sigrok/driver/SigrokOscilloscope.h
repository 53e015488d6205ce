// SigrokOscilloscope.h - an oscilloscope that libsigrok speaks to.
//
// The instrument lives on a thread of its own (SigrokThread.h); the bench waits for it in arm() only, until it
// waits for triggers (some 0.1 s, at most 6 s); poll() takes what has come. What goes wrong in between is poll()'s
// error, and final: the device has to be opened again. An instrument from which nothing has come for some seconds
// although something must is a Timeout.
//
// Time stamps are the host's, taken when the samples arrive: libsigrok passes on no time of the trigger. Within a
// record times are the instrument's; from record to record they are late by what reading it out takes (some 0.1 s).
//
// Thread-safety: as Oscilloscope. Destruction takes at most 2 s; an instrument that keeps libsigrok longer is left to
// its thread.
#pragma once

#include <memory>

#include "core/base/Clock.h"
#include "core/devices/Driver.h"
#include "core/devices/Oscilloscope.h"
#include "drivers/sigrok/protocol/ScopeUri.h"

namespace tacto::sigrok_driver {

/// Opens what `uri` names. `itself` is the URI that the identity carries. Takes at most 12 s.
/// Errors: InvalidArgument, NotFound, Device, Timeout, Io.
[[nodiscard]] Result<std::unique_ptr<Oscilloscope>> openOscilloscope(const ScopeUri& uri, const std::string& itself,
                                                                     const Clock& clock);

}  // namespace tacto::sigrok_driver
