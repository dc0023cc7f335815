# Toolchain: Debian's gcc-arm-none-eabi, for a Cortex-A9 with NEON.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)  # CMake's own test program has no linker script

# Floats are VFP's: GCC takes NEON, which flushes denormals to zero, for integers only (run.py looks). Sections for the
# linker to drop; no word on an ABI change of GCC 7, for all is built by one compiler; file names relative, so that the
# program is the same bytes wherever it is built.
cmake_path(GET CMAKE_CURRENT_LIST_DIR PARENT_PATH boards_folder)
cmake_path(GET boards_folder PARENT_PATH source_folder)
string(JOIN " " CMAKE_CXX_FLAGS_INIT
  -mcpu=cortex-a9 -marm -mfloat-abi=hard -mfpu=neon -mno-unaligned-access -ffp-contract=off
  -fno-exceptions -fno-rtti -fno-threadsafe-statics -ffunction-sections -fdata-sections -Wno-psabi
  -ffile-prefix-map=${source_folder}/=)
