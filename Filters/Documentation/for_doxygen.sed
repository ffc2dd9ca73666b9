# Members that every VTK class has are left out: VTK's own documentation explains them.
/ New\(\);| PrintSelf\(| RequestData\(| FillOutputPortInformation\(/d
# The point of "eq. 9" does not end the sentence that summarises a member.
s/\b(eqs?)\. /\1.\\ /g
# Pictures are found by their name (IMAGE_PATH).
s#\]\(\.\./\.\./Examples/Pictures/#](#g
# Links to files of the source tree would lead nowhere from the HTML pages: only their text stays.
s#\[([^]]*)\]\(\.\./[^)]*\)#\1#g
