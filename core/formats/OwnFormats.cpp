#include "core/formats/CaptureFormats.h"
#include "core/formats/CsvFormat.h"
#include "core/formats/IsfFormat.h"
#include "core/formats/WavFormat.h"

namespace tacto {

void addOwnFormats(CaptureFormats& formats) {
    formats.add(std::make_unique<WavFormat>());
    formats.add(std::make_unique<IsfFormat>());
    for (const auto dialect : {CsvDialect::Rigol, CsvDialect::Siglent, CsvDialect::Tektronix, CsvDialect::Keysight,
                               CsvDialect::PicoScope, CsvDialect::Plain}) {
        formats.add(std::make_unique<CsvFormat>(dialect));
    }
}

std::shared_ptr<const CaptureFormats> ownCaptureFormats() {
    auto formats = std::make_shared<CaptureFormats>();
    addOwnFormats(*formats);
    return formats;
}

}  // namespace tacto
