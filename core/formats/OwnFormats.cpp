#include "core/formats/CaptureFormats.h"
#include "core/formats/IsfFormat.h"
#include "core/formats/WavFormat.h"
#include "core/formats/csv/CsvFormat.h"
#include "core/formats/csv/CsvMakers.h"

namespace tacto {

void addOwnFormats(CaptureFormats& formats) {
    formats.add(std::make_unique<WavFormat>());
    formats.add(std::make_unique<IsfFormat>());
    for (const auto& maker : csvMakers()) formats.add(std::make_unique<CsvFormat>(maker.dialect));
    formats.add(std::make_unique<CsvFormat>(CsvDialect::Plain));
}

std::shared_ptr<const CaptureFormats> ownCaptureFormats() {
    auto formats = std::make_shared<CaptureFormats>();
    addOwnFormats(*formats);
    return formats;
}

}  // namespace tacto
