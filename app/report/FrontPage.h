// FrontPage.h - what stands below the verdict on a report's first page: how it was decided, what it rests on, what was
// not evaluated, and who did it and who checked it.
//
// Thread-safety: the GUI thread.
#pragma once

#include <vector>

#include "app/report/Captions.h"

namespace tacto {

void addFrontPage(const ReportModel& model, Captions& captions, std::vector<ReportBlock>& blocks);

}  // namespace tacto
