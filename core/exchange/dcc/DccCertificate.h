// DccCertificate.h - what the digital calibration certificates of an oscilloscope or a multimeter, of its shunt and its
// probe state of the figures that this program uses (Certificate in core/calibration).
//
// A figure is the largest of its points, in % of the reading: the expanded uncertainty, brought to k = 2 but never
// below what is stated, plus the error that the certificate states, because readings are not corrected for it (GUM
// F.2.4.5). Which figure a quantity is, its unit and its words say: volts are the voltage gain, a time or a frequency
// that is called so the time base, ohms of a shunt the shunt. Figures that no file states stay unknown (hazard H9). One
// that a file states in a way that leaves a doubt (readings without error, of several items without saying whose) is
// refused unless it is given.
//
// Thread-safety: pure functions.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/calibration/CertificateStore.h"
#include "core/exchange/dcc/DccFile.h"

namespace tacto {

struct DccCertificate {
    Certificate certificate;
    std::vector<std::string> notes;  ///< sentences: what each figure is made of, and how each file is signed
};

/// `files`: the instrument's own certificate first, then those of its shunt or probe, whose figures are added. It
/// counts from the latest of their days until the earliest on which one is due. `given`: what was entered beside them;
/// an empty text, a day that does not exist and no figure mean nothing. Of several items it chooses by the serial
/// number, and takes only results that refer to that item. Errors: InvalidArgument, one sentence: what is missing and
/// how it can be given, what contradicts `given`, a figure in doubt or stated by two of the files that is not given, a
/// unit that is none for its figure, a number that is absent, a certificate of a simulated bench; as check().
[[nodiscard]] Result<DccCertificate> certificateFrom(std::span<const DccFile> files, const Certificate& given);

/// Whether it states a voltage gain, well or not: then it is an instrument's own, and no shunt's or probe's.
[[nodiscard]] bool statesGain(const DccFile& file);

}  // namespace tacto
