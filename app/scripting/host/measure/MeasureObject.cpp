// The object "measure", reading captures: what scripts can call, and what each function takes and returns.
#include "app/scripting/host/measure/MeasureObject.h"

namespace tacto {

std::vector<HostFunction> measureFunctions() {
    using namespace takes;
    return {
        {.name = "train",
         .parameters = {list("captures", "from bench.capture(), in time order")},
         .text = "Measures what was delivered: amplitude, width, charge of each train, and the interval from onset to "
                 "onset.",
         .returns = "{ amplitude_v, amplitude_u_v, amplitude_gain_u, amplitude_ma, interval_s, interval_u_s, "
                    "time_base_u, width_s, charge_uc, imbalance, trains, pulses, warnings, captures }: means over the "
                    "trains; _u_ is the standard uncertainty of a reading, amplitude_gain_u the part of it that the "
                    "gain makes, relative, time_base_u that of the time base, relative; what could not be measured is "
                    "null, the interval of a single train among it.",
         .errors = "Throws for captures that are held no longer, or without a voltage channel.",
         .call = host::measure::train},
        {.name = "pulse",
         .parameters = {list("captures", "from bench.capture(), in time order")},
         .text = "One reading for a calibration: what came out beside what was commanded, and what the oscilloscope "
                 "states of itself.",
         .returns =
             "{ unit, amplitude, interval_s, width_s, gap_s, trains, warnings, commanded: { amplitude, interval_s, "
             "width_s, gap_s }, instrument: { gain_tolerance, offset_tolerance, resolution, sampling_step_s, "
             "full_scale }, load_ohm, load_expanded_ohm, captures, reading }: reading is its number in this run, for "
             "analysis.calibration(); amplitude in unit, V or mA by the stimulator's source; what could not be "
             "measured or is not stated is null; load_ohm is V / I, load_expanded_ohm its U from what both channels "
             "state.",
         .errors = "Throws for captures that are held no longer, or without the channel that is read.",
         .needs = Role::Stimulator,
         .call = host::measure::pulse},
        {.name = "load",
         .parameters = {list("captures", "from bench.capture(), one per train, all with one command"),
                        list("fine",
                             "more of them in a current range that fits the end of a phase: a spike may clip there")
                            .optional(),
                        list("rhythm",
                             "one capture that holds two of the trains, for the interval: for an oscilloscope that "
                             "does not state how good the time stamps of its records are")
                            .optional(),
                        text("by",
                             "where the voltage shows the phases of a current source's train too: into an open circuit")
                            .oneOf({"voltage"})
                            .optional()},
         .text = "Measures what trains did to a load: voltage, current, charge, energy, RMS over each window.",
         .returns =
             "{ delivered, amplitude_v, highest_v, amplitude_ma, width_s, rate_hz, interval_s, impedance_ohm, peak_v, "
             "peak_ma, charge_uc, net_charge_uc, imbalance, energy_mj, rms_train_ma, rms_1s_ma, rms_5s_ma, "
             "rms_5s_v, dc_ma, power_1s_w, each with its standard uncertainty in _u and its U (95 %) in "
             "_expanded; trains, under_10_lsb, not_stated, warnings, captures }: null what was not measured, "
             "and an uncertainty that rests on what the oscilloscope does not state (not_stated says what); "
             "delivered is the amplitude over what each train was to have, 1 as programmed.",
         .errors = "Throws for captures that are held no longer, or without a channel of what the source drives and of "
                   "voltage.",
         .call = host::measure::measureLoad},
    };
}

}  // namespace tacto
