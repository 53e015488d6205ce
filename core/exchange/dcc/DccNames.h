// DccNames.h - names in digital calibration certificates that reading and writing share: namespaces, and the reference
// types by which a program knows what an element is. Those that begin with "basic_" are PTB's common ones (doi
// 10.5281/zenodo.8021092), the others are ours.
//
// Thread-safety: constants.
#pragma once

namespace tacto::dcc {

inline constexpr const char* kNamespace = "https://ptb.de/dcc";
inline constexpr const char* kUnitNamespace = "https://ptb.de/si";

inline constexpr const char* kSerial = "basic_serialNumber";
inline constexpr const char* kNominal = "basic_nominalValue";
inline constexpr const char* kReference = "basic_referenceValue";
inline constexpr const char* kMeasured = "basic_measuredValue";
inline constexpr const char* kError = "basic_measurementError";
inline constexpr const char* kRecalibration = "basic_recalibration";
inline constexpr const char* kSimulated = "tactoscope_simulated";
inline constexpr const char* kMark = "tactoscope_mark";
inline constexpr const char* kTolerance = "tactoscope_tolerance";
inline constexpr const char* kVerdict = "tactoscope_verdict";

}  // namespace tacto::dcc
