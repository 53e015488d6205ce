// The object "loads", commands on known loads: what scripts can call, and what each function takes and returns.
#include "app/scripting/host/loads/LoadsObject.h"

#include "app/scripting/engine/Arming.h"

namespace tacto {

std::vector<HostFunction> loadsFunctions() {
    using namespace takes;
    constexpr double kMaxCommands = 101;
    const auto resistor = text("load", "a resistor or a skin equivalent");
    const auto count =
        whole("count", "how many, from the weakest amplitude to the strongest in even steps").range(2, kMaxCommands);
    const auto command = object("command", "from loads.commands() or loads.strongest()");
    const auto commandLoad = text("command.load", "the load that is armed");
    const auto strength = number("command.strength", "", "0 the weakest amplitude to 1 the strongest").range(0, 1);
    return {
        {.name = "commands",
         .parameters = {resistor, count},
         .text = "The commands that are to be given on a load, from the weakest up, at the shortest interval; nothing "
                 "is delivered.",
         .returns = "List of what bench.predict() returns.",
         .errors = "Throws without a stimulator.",
         .needs = Role::Stimulator,
         .call = host::loads::commands},
        {.name = "strongest",
         .parameters = {resistor, count},
         .text = "The strongest of loads.commands() that the device can give and the limits allow.",
         .returns = "As bench.predict(); null where there is none.",
         .errors = "Throws without a stimulator.",
         .needs = Role::Stimulator,
         .call = host::loads::strongest},
        {.name = "arm",
         .parameters = {load("load", "that is fitted; ± 20 % for the limits")},
         .text = "Arms as bench.arm() does. What is wrong with this load ends its part of the check and not the run.",
         .returns = "\"\" when armed, else why not.",
         .errors = "Throws without the operator's confirmation, for a fault, and when the run is stopped.",
         .asks = kConfirmArming,
         .failsDisarmed = true,
         .call = host::loads::arm},
        {.name = "askToArm",
         .parameters = {command, commandLoad},
         .text = "Asks to arm where the impedance check alone breaks a limit, and disarms. It must be refused, and by "
                 "a limit: arming that fails for another reason says nothing about the limits and is this load's "
                 "problem.",
         .returns = "{ refusals } or { problem }, for the load in analysis.loadSafety().",
         .errors = "As loads.arm().",
         .asks = kConfirmArming,
         .needs = Role::Stimulator,
         .failsDisarmed = true,
         .call = host::loads::askToArm},
        {.name = "give",
         .parameters = {command, commandLoad, strength,
                        whole("trains", "to be read; more are delivered, one of them to reach the level").range(1, 20)},
         .text = "Gives a command on the load that is armed. What the limits forbid is asked for once and must be "
                 "refused; else the trains are captured and read, the end of a phase in a current range of its own "
                 "where a charging spike is far above it. A refusal is not an error here. The drive is off afterwards.",
         .returns =
             "{ list, entry }: the list of a load of analysis.loadSafety() that the entry belongs to, \"steps\", "
             "\"refusals\" or, where the device cannot give the command, \"undriven\". A step is { condition, "
             "command_v, interval_s, rate_hz, reading }, reading as measure.load() returns it.",
         .errors = "Throws without an oscilloscope, for a fault, when fewer trains came, and when the run is stopped.",
         .needs = Role::Oscilloscope,
         .call = host::loads::give},
        {.name = "burst",
         .parameters = {command, commandLoad, strength},
         .text = "Captures three trains of a command in one record, on the load that is armed.",
         .returns = "{ command_v, interval_s, rate_hz, captures }; captures for record.trial().",
         .errors = "As loads.give().",
         .needs = Role::Oscilloscope,
         .call = host::loads::burst},
    };
}

}  // namespace tacto
