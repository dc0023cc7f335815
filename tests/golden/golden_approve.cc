// Makes today's pictures the goldens, and says what that changes. Run by approve.sh.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "sim/image/compare.h"
#include "sim/image/png.h"
#include "tests/golden/golden_store.h"
#include "tests/golden/subjects.h"

namespace usuzumi::golden {
namespace {

void tell_change(const Store& store, const Subject& subject, const sim::Image& picture, std::uint32_t crc) {
  const Entry* old = store.find(subject.name);
  if (old == nullptr) {
    std::printf("new      %-24s %08x\n", subject.name, crc);
    return;
  }
  std::printf("changed  %-24s %08x -> %08x\n", subject.name, old->crc32, crc);
  const std::filesystem::path path = store.picture_path(subject.name);
  if (std::filesystem::exists(path))
    std::printf("%s", sim::report_text(sim::compare_images(sim::read_png(path), picture)).c_str());
}

bool up_to_date(const Store& store, const Subject& subject, const sim::Image& picture) {
  const Entry* entry = store.find(subject.name);
  const std::filesystem::path path = store.picture_path(subject.name);
  return entry != nullptr && entry->note == subject.note && entry->crc32 == sim::picture_crc32(picture) &&
         std::filesystem::exists(path) && sim::read_png(path) == picture;
}

void approve_subject(Store& store, const Subject& subject) {
  const sim::Image picture = subject.draw();
  if (up_to_date(store, subject, picture)) return;
  const std::uint32_t crc = sim::picture_crc32(picture);
  tell_change(store, subject, picture, crc);
  store.put({subject.name, picture.width, picture.height, crc, subject.note}, picture);
}

// Goldens of what is no more.
void remove_stale(Store& store, std::span<const Subject> subjects) {
  std::set<std::string> stale;
  for (const Entry& entry : store.entries()) stale.insert(entry.scene);
  for (const std::string& picture : store.pictures_on_disk()) stale.insert(picture);
  for (const Subject& subject : subjects) stale.erase(subject.name);
  for (const std::string& name : stale) {
    std::printf("removed  %s\n", name.c_str());
    store.remove(name);
  }
}

// Those whose name begins with one of the words; all of them where there are none.
std::vector<Subject> subjects_named(std::span<char*> words) {
  std::vector<Subject> all = all_subjects();
  if (words.empty()) return all;
  std::vector<Subject> named;
  const auto begins_with = [](const Subject& subject, const char* word) {
    return std::string_view(subject.name).starts_with(word);
  };
  for (const char* word : words)
    if (std::none_of(all.begin(), all.end(), [&](const Subject& s) { return begins_with(s, word); }))
      throw std::runtime_error(std::string(word) + ": no golden begins so; they are named as the PNGs in tests/golden");
  for (const Subject& subject : all)
    if (std::any_of(words.begin(), words.end(), [&](const char* word) { return begins_with(subject, word); }))
      named.push_back(subject);
  return named;
}

void approve(std::span<char*> words) {
  Store store(Store::source_folder());
  const std::vector<Subject> subjects = subjects_named(words);
  for (const Subject& subject : subjects) approve_subject(store, subject);
  if (words.empty()) remove_stale(store, subjects);
  std::printf("%zu goldens in %s; what is not listed above is as it was\n", store.entries().size(),
              Store::source_folder().c_str());
}

}  // namespace
}  // namespace usuzumi::golden

int main(int argc, char** argv) {
  try {
    usuzumi::golden::approve(std::span<char*>(argv, static_cast<std::size_t>(argc)).subspan(1));
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
