#include "app/run/RunNotes.h"

#include "core/base/Printable.h"

namespace tacto {

namespace {

struct Note {
    const char* key;
    const char* title;
    std::string RunNotes::*text;
};
constexpr Note kNotes[] = {{"operator", "operator", &RunNotes::operatorName},
                           {"sample", "sample", &RunNotes::sample},
                           {"reviewer", "reviewer", &RunNotes::reviewer},
                           {"ambient", "ambient conditions", &RunNotes::ambient}};

}  // namespace

Result<void> checkNotes(const RunNotes& notes) {
    for (const auto& note : kNotes) {
        const auto& text = notes.*note.text;
        if (printable(text) != text) {
            return fail(ErrorCode::InvalidArgument,
                        "the {} is \"{}\"; one line of text without control characters is expected", note.title,
                        printable(text));
        }
        if (const auto length = charactersOf(text); length > kNoteLimit) {
            return fail(ErrorCode::InvalidArgument, "the {} has {} characters; at most {} are accepted", note.title,
                        length, kNoteLimit);
        }
    }
    return {};
}

Result<void> keepNotes(const RunNotes& notes, SessionWriter& session, Instant at) {
    nlohmann::json item = {{"kind", "notes"}};
    for (const auto& note : kNotes)
        if (const auto& text = notes.*note.text; !text.empty()) item[note.key] = text;
    if (item.size() == 1) return {};
    const auto kept = session.reportItem(at, item);
    if (!kept) return failure(kept);
    return {};
}

}  // namespace tacto
