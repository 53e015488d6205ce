// ScopeUri.h - which instrument a sigrok: URI names, and how it is wired.
//
//   sigrok:demo
//   sigrok:rigol-ds:conn=tcp-raw/192.0.2.1/5555?voltage=CH1&current=CH2&shunt=100ohm&probe=10
//
// The path is a libsigrok driver and its options, as `sigrok-cli -d` takes them. The parameters say what is connected
// to which channel:
//   voltage=NAME    the channel across the load; by default the first channel
//   current=NAME    the channel across the shunt; without it only the voltage is captured
//   shunt=OHMS      the low-side shunt, needed with current=; 1 milliohm to 1 megohm
//   probe=N, currentprobe=N   attenuation of the probes (1, 10, ...); by default the instrument's own setting stays
//   slope=rise|fall           the edge that instruments trigger on; fall for pulses that begin negative
//   trigger=set|instrument    instrument: its own panel sets the trigger; for drivers that cannot set it
//   record=memory|live        what is read if an instrument offers both: see RecordPlan.h
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Units.h"
#include "core/devices/DeviceUri.h"

namespace tacto::sigrok_driver {

struct ScopeUri {
    std::string driver;                                        ///< libsigrok's name of the driver, such as "rigol-ds"
    std::vector<std::pair<std::string, std::string>> options;  ///< options of the scan, such as "conn"
    std::optional<std::string> voltage;
    std::optional<std::string> current;
    Ohms shunt{0};  ///< above 0 if `current` is given
    std::optional<std::uint64_t> voltageProbe;
    std::optional<std::uint64_t> currentProbe;
    bool falling = false;
    bool ownTrigger = false;
    bool live = false;

    /// Errors: InvalidArgument naming the wrong part and what it accepts.
    [[nodiscard]] static Result<ScopeUri> parse(const DeviceUri& uri);

    /// Returns host and port if `conn` is a plain TCP connection ("tcp-raw/HOST/PORT", "tcp-rigol/HOST/PORT").
    [[nodiscard]] std::optional<std::pair<std::string, std::string>> tcp() const;
    /// Returns the options with the host and port of the TCP connection replaced.
    [[nodiscard]] std::vector<std::pair<std::string, std::string>> optionsVia(const std::string& host,
                                                                              std::uint16_t port) const;
};

}  // namespace tacto::sigrok_driver
