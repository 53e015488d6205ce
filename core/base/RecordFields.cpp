#include "core/base/RecordFields.h"

#include <memory>
#include <utility>

namespace tacto {

using nlohmann::json;

const void* RecordTable::Field::held(const void* record) const {
    const void* member = static_cast<const std::byte*>(record) + offset;
    return optional != nullptr ? optional->get(member) : member;
}

void RecordTable::Field::clear(void* record) const {
    if (optional != nullptr) optional->reset(in(record));
}

Result<void> RecordTable::Field::read(const json& value, void* record, const RecordPlace& place) const {
    void* member = in(record);
    auto done = kind.readInto(value, optional != nullptr ? optional->emplace(member) : member, place, kind.info.key);
    if (!done) clear(record);  // for a damaged row: an unread value is empty, not 0
    return done;
}

json RecordTable::Field::write(const void* record) const {
    const void* member = held(record);
    return member != nullptr ? kind.writeFrom(member) : json();
}

FieldInfo& RecordTable::add(std::string_view key, std::size_t offset, AnyKind kind, const OptionalAccess* optional) {
    kind.info.key = key;
    kind.info.mayBeNull = optional != nullptr;
    return fields_.emplace_back(Field{std::move(kind), offset, optional}).kind.info;
}

void RecordTable::note(std::string_view key, const AcceptedText& accepted) {
    AnyKind kind;
    kind.readInto = [text = textKind(accepted)](const json& value, void*, const RecordPlace& place,
                                                std::string_view name) {
        std::string read;
        return text.read(value, read, place, name);
    };
    kind.writeFrom = [](const void*) { return json(); };
    add(key, 0, std::move(kind)).leftOutIfEmpty = true;
}

Result<void> RecordTable::read(const json& object, void* into, const RecordPlace& place) const {
    std::vector<std::string_view> keys;
    for (const auto& field : fields_) keys.push_back(field.kind.info.key);
    const auto known = passOver_ ? expectObject(object, place.text()) : onlyKeys(object, keys, place.text());
    if (!known && !place.lenient) return known;
    for (const auto& field : fields_) {
        const auto& info = field.kind.info;
        const auto found = object.find(info.key);
        Result<void> done;
        const bool isNull = found != object.end() && found->is_null();
        const bool isThere = found != object.end() && !(isNull && nullIsMissing_);
        if (isNull && info.mayBeNull && !info.leftOutIfEmpty)
            field.clear(into);
        else if (info.required && (!isThere || isNull))
            done = place.refuse(ErrorCode::ParseError, info.key, "missing", info.accepted);
        else if (isThere)
            done = field.read(*found, into, place);
        if (!done && !place.lenient) return done;
    }
    return place.lenient ? Result<void>() : checkRules(into, place);
}

json RecordTable::write(const void* record) const {
    if (absent_ && absent_(record)) return nullptr;
    auto out = json::object();
    for (const auto& field : fields_) {
        auto value = field.write(record);
        if (!field.kind.info.leftOutIfEmpty || !value.empty()) out[field.kind.info.key] = std::move(value);
    }
    return out;
}

Result<void> RecordTable::check(const void* record, const RecordPlace& place) const {
    for (const auto& field : fields_) {
        const void* held = field.kind.checkOf ? field.held(record) : nullptr;
        if (held == nullptr) continue;
        if (auto sound = field.kind.checkOf(held, place, field.kind.info.key); !sound) return sound;
    }
    return checkRules(record, place);
}

Result<void> RecordTable::checkRules(const void* record, const RecordPlace& place) const {
    for (const auto& holds : rules_) {
        if (auto sound = holds(record); !sound) return place.refuse(std::move(sound.error()));
    }
    return {};
}

std::vector<FieldInfo> RecordTable::infos() const {
    std::vector<FieldInfo> all;
    for (const auto& field : fields_) all.push_back(field.kind.info);
    return all;
}

AnyKind RecordTable::kind() const {
    const auto fields = std::make_shared<const RecordTable>(*this);
    AnyKind kind{.info = {.accepted = "an object", .members = infos()}};
    kind.readInto = [fields](const json& value, void* into, const RecordPlace& place, std::string_view key) {
        return fields->read(value, into, place.in(key));
    };
    kind.writeFrom = [fields](const void* record) { return fields->write(record); };
    kind.checkOf = [fields](const void* record, const RecordPlace& place, std::string_view key) {
        return fields->check(record, place.in(key));
    };
    return kind;
}

}  // namespace tacto
