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

void tell_changed_lines(const Store& store, const Subject& subject, const Drawn& drawn) {
  for (const Entry& entry : drawn.entries) {
    const Entry* old = store.find(entry.name);
    if (old == nullptr) std::printf("new      %-28s %08x\n", entry.name.c_str(), entry.crc32);
    else if (*old != entry) std::printf("changed  %-28s %08x -> %08x\n", entry.name.c_str(), old->crc32, entry.crc32);
  }
  const auto has = [&](const std::string& name) {
    return std::any_of(drawn.entries.begin(), drawn.entries.end(), [&](const Entry& e) { return e.name == name; });
  };
  for (const Entry& old : store.entries_of(subject.name))
    if (!has(old.name)) std::printf("removed  %s\n", old.name.c_str());
  if (store.exclusions_of(subject.name) != subject.exclusions)
    std::printf("changed  the boards that %s is not on\n", subject.name);
}

/// Whether the PNG shows the picture; what differs is told.
bool png_up_to_date(const Store& store, const Subject& subject, const sim::Image& picture) {
  const std::filesystem::path path = store.picture_path(subject.name);
  if (!std::filesystem::exists(path)) return false;
  const sim::Image old = sim::read_png(path);
  if (old == picture) return true;
  std::printf("%s", sim::report_text(sim::compare_images(old, picture)).c_str());
  return false;
}

void approve_subject(Store& store, const Subject& subject) {
  const Drawn drawn = subject.draw();
  tell_changed_lines(store, subject, drawn);
  const bool same_png = png_up_to_date(store, subject, drawn.picture);
  if (same_png && store.entries_of(subject.name) == drawn.entries &&
      store.exclusions_of(subject.name) == subject.exclusions)
    return;
  store.put(drawn.entries, subject.exclusions, drawn.picture);
}

// Goldens of what is no more.
void remove_stale(Store& store, std::span<const Subject> subjects) {
  std::set<std::string> stale;
  for (const Entry& entry : store.entries()) stale.emplace(case_of(entry.name));
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
  std::printf("%zu lines in %s/manifest; what is not listed above is as it was\n", store.entries().size(),
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
