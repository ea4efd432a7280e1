# Writes the header OUT that names the commit of SOURCE, and touches it only when that has changed.
# Called as: cmake -DSOURCE=… -DOUT=… -P tools/commit.cmake
set(commit "unknown")
execute_process(COMMAND git -C ${SOURCE} describe --always --abbrev=12 --exclude=* --dirty OUTPUT_VARIABLE described
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE status)
if(status EQUAL 0 AND described)
  set(commit ${described})
endif()
file(CONFIGURE OUTPUT ${OUT} CONTENT "#define ARGIL_COMMIT \"@commit@\"\n" @ONLY)
