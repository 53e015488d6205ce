// EdfNames.h - the fields of EDF(+) and BDF(+) headers (edfplus.info/specs), and the words of our own files.
//
// Thread-safety: constants, and the lock of EDFlib.
#pragma once

#include <cstddef>
#include <mutex>
#include <string_view>

namespace tacto::edf {

/// What both begin with: "0" and blanks, or a byte of 255 and "BIOSEMI".
inline constexpr std::string_view kEdfMagic = "0       ", kBdfMagic =
                                                              "\xFF"
                                                              "BIOSEMI";

struct HeaderField {
    std::size_t at, bytes;
    [[nodiscard]] constexpr std::string_view in(std::string_view header) const { return header.substr(at, bytes); }
};
// Of the file. The header is kHeaderBytes, and as many again for each signal.
inline constexpr std::size_t kHeaderBytes = 256;
inline constexpr HeaderField kRecording{88, 80}, kHeaderSize{184, 8}, kReserved{192, 44}, kRecords{236, 8},
    kDuration{244, 8}, kSignals{252, 4};
// Of a signal: each field of all signals stands together, so `at` is to be multiplied by their number.
inline constexpr HeaderField kLabel{0, 16}, kTransducer{16, 80}, kUnit{96, 8}, kPhysicalMin{104, 8},
    kPhysicalMax{112, 8}, kDigitalMin{120, 8}, kDigitalMax{128, 8}, kSamples{216, 8};

inline constexpr std::string_view kAnnotations[] = {"EDF Annotations", "BDF Annotations"};

// What EDFlib takes.
inline constexpr std::size_t kMaxSignals = 640;
inline constexpr std::size_t kMaxRecordBytesEdf = 10 << 20, kMaxRecordBytesBdf = 15 << 20;

// What is written.
inline constexpr std::string_view kAbsentNote = "digital minimum = absent";  ///< the prefilter of each signal
inline constexpr std::size_t kAnnotationBytes = 120;  ///< of an annotation signal in a record, as EDFlib has it
inline constexpr std::size_t kMaxAnnotationSignals = 64, kMaxAnnotationText = 40;

// Our own files: the equipment in the field of the recording. In them alone the lowest digital value means absent.
inline constexpr std::string_view kEquipment = "Tactoscope_", kSimulatedEquipment = "_SIMULATED";

/// EDFlib keeps all open files in one table: opening and closing is one thread's at a time.
[[nodiscard]] std::mutex& edflibTable();

}  // namespace tacto::edf
