# Left out: what every VTK class has, and VTK's own documentation explains.
/ New\(\);| PrintSelf\(| RequestData\(| FillOutputPortInformation\(/d
# The point of "eq. 9" does not end the sentence that is a member's summary.
s/\b(eqs?)\. /\1.\\ /g
